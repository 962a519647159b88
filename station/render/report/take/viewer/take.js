// The take of a report: the drummer, the sound and the place in the score, all by the clock of the sound.
"use strict";

(() => {
    const FLASH = 0.6; // of the light that a stroke of full velocity begins with
    const FLASH_FADES_S = 0.16; // a stroke's light is down to a third after so long
    const LATEST_S = 1.2; // and gone after so long
    const ORBIT_RAD_A_PIXEL = 0.008;
    const ORBIT_RAD_A_KEY = 0.12;
    const [NEAREST_M, FARTHEST_M] = [0.8, 6.0];
    const PIXELS_A_POINT = [2, 1, 0.6]; // at most, on computers that draw quickly, slowly, very slowly
    const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i; // what draws without a graphics card
    const SLOW_MS = 55;
    const SLOW_FRAMES = 6; // so many slow ones in a row are no accident
    const STATES = ["match", "early", "late", "miss", "wrong_piece", "unknown", "unplayed", "extra", "free"];

    const part = document.querySelector(".take");
    const audio = part.querySelector("audio");
    const times = JSON.parse(part.querySelector(".take-times").textContent);

    // --- the place in the score --------------------------------------------------------------------------------------

    // the last entry of a rising list that is not after a time; -1 before the first
    function before(count, timeOf, time) {
        let [low, high] = [0, count];
        while (low < high) {
            const middle = (low + high) >> 1;
            if (timeOf(middle) <= time) low = middle + 1;
            else high = middle;
        }
        return low - 1;
    }

    // straight between points (x, y), x rising; null outside
    function between(points, x) {
        const last = points.length - 1;
        const at = Math.min(before(points.length, (k) => points[k][0], x), last - 1);
        if (at < 0 || x > points[last][0]) return null;
        const [[x0, y0], [x1, y1]] = [points[at], points[at + 1]];
        return x1 > x0 ? y0 + ((x - x0) / (x1 - x0)) * (y1 - y0) : y1;
    }

    // the bars that the page has engraved: a play line for each system, and the notes
    class Bars {
        constructor() {
            this.systems = [...document.querySelectorAll("svg.bars[data-line]")].map((svg) => ({
                line: JSON.parse(svg.dataset.line),
                mark: svg.querySelector(".play-line"),
            }));
            this.notes = new Map();
            for (const note of document.querySelectorAll("svg.bars .note[data-note]")) {
                const index = Number(note.dataset.note);
                const own = STATES.filter((state) => note.classList.contains(state));
                this.notes.set(index, [...(this.notes.get(index) ?? []), { note, own }]);
            }
            this.shown = { pass: -1, count: -1, begun: false };
        }

        show(time, begun) {
            const { passes } = times;
            const at = before(passes.length, (k) => passes[k].ticks[0][0], time);
            const pass = passes[at];
            this.place(begun && pass ? between(pass.ticks, time) : null);
            const count = pass ? before(pass.notes.length, (k) => pass.notes[k][1], time) + 1 : 0;
            const shown = this.shown;
            if (shown.pass === at && shown.count === count && shown.begun === begun) return;
            this.colour(at, count, begun);
            this.shown = { pass: at, count, begun };
            part.querySelector(".take-pass").textContent =
                begun && at >= 0 && passes.length > 1 ? `Pass ${at + 1} of ${passes.length}` : "";
        }

        place(tick) {
            for (const { line, mark } of this.systems) {
                if (!mark) continue;
                const x = tick === null ? null : between(line, tick);
                mark.style.display = x === null ? "none" : "inline";
                mark.style.visibility = x === null ? "hidden" : "visible";
                mark.removeAttribute("hidden");
                if (x === null) continue;
                mark.setAttribute("x1", x);
                mark.setAttribute("x2", x);
            }
        }

        // as the whole session was, until something plays; then note by note as this pass was
        colour(at, count, begun) {
            const { shown } = this;
            const goesOn = begun && shown.begun && at === shown.pass && count >= shown.count;
            if (!goesOn) {
                for (const drawn of this.notes.values()) {
                    for (const { note, own } of drawn) {
                        note.classList.remove(...STATES);
                        if (!begun) note.classList.add(...own);
                    }
                }
            }
            if (!begun || at < 0) return;
            for (const [index, , state] of times.passes[at].notes.slice(goesOn ? shown.count : 0, count)) {
                for (const { note } of this.notes.get(index) ?? []) {
                    note.classList.remove(...STATES);
                    note.classList.add(state);
                }
            }
        }
    }

    // --- the picture -------------------------------------------------------------------------------------------------

    // round a target, from an angle about the vertical, an angle above the horizon and a distance
    class Orbit {
        constructor(view) {
            this.take(view);
        }

        take({ eye, target, fov, narrow }) {
            const [x, y, z] = eye.map((value, k) => value - target[k]);
            this.distance = Math.hypot(x, y, z);
            this.azimuth = Math.atan2(x, z);
            this.height = Math.asin(y / this.distance);
            Object.assign(this, { target, fov, narrow });
        }

        turn(right, up) {
            this.azimuth -= right;
            this.height = Math.min(1.5, Math.max(-0.05, this.height + up));
        }

        zoom(factor) {
            this.distance = Math.min(FARTHEST_M, Math.max(NEAREST_M, this.distance * factor));
        }

        aim(camera, aspect) {
            const flat = this.distance * Math.cos(this.height);
            const [x, y, z] = this.target;
            camera.position.set(
                x + flat * Math.sin(this.azimuth),
                y + this.distance * Math.sin(this.height),
                z + flat * Math.cos(this.azimuth),
            );
            camera.lookAt(x, y, z);
            const half = Math.tan((this.fov * Math.PI) / 360) * Math.max(1, this.narrow / aspect);
            camera.fov = (Math.atan(half) * 360) / Math.PI;
            camera.aspect = aspect;
            camera.updateProjectionMatrix();
        }
    }

    // soft boxes round the stage, which metal mirrors
    function surroundings(three, renderer) {
        const room = new three.Scene();
        const box = (colour, size, at) => {
            const mesh = new three.Mesh(
                new three.BoxGeometry(...size),
                new three.MeshBasicMaterial({ color: new three.Color(...colour) }),
            );
            mesh.position.set(...at);
            room.add(mesh);
        };
        const walls = new three.Mesh(
            new three.BoxGeometry(12, 8, 12),
            new three.MeshBasicMaterial({ color: new three.Color(0.11, 0.13, 0.18), side: three.BackSide }),
        );
        room.add(walls);
        box([5.5, 4.9, 4.2], [3.5, 0.1, 2.5], [-1.5, 3.9, 2.5]);
        box([1.6, 2.4, 3.6], [0.1, 3.0, 3.0], [5.9, 1.5, -2.0]);
        box([3.0, 1.8, 0.9], [0.1, 2.4, 2.4], [-5.9, 1.0, -2.5]);
        box([0.30, 0.20, 0.15], [12, 0.1, 12], [0, -3.9, 0]);
        const generator = new three.PMREMGenerator(renderer);
        const { texture } = generator.fromScene(room, 0, 0.1, 100, { size: 64 });
        generator.dispose();
        return texture;
    }

    // boards under a spot, and a rug
    function floor(three) {
        const size = 1024;
        const paper = document.createElement("canvas");
        paper.width = paper.height = size;
        const pen = paper.getContext("2d");
        const ring = (share, colour) => {
            pen.fillStyle = colour;
            pen.beginPath();
            pen.arc(size / 2, size / 2, (share * size) / 2, 0, 2 * Math.PI);
            pen.fill();
        };
        const wood = pen.createRadialGradient(size / 2, size / 2, 0, size / 2, size / 2, size / 2);
        wood.addColorStop(0, "#6b5140");
        wood.addColorStop(0.55, "#43342c");
        wood.addColorStop(1, "#0e1118");
        pen.fillStyle = wood;
        pen.fillRect(0, 0, size, size);
        ring(0.44, "#9c8466");
        ring(0.43, "#1f2a44");
        ring(0.4, "#9a6a38");
        ring(0.39, "#541a1d");
        ring(0.2, "#9a6a38");
        ring(0.19, "#1f2a44");
        const texture = new three.CanvasTexture(paper);
        texture.colorSpace = three.SRGBColorSpace;
        texture.anisotropy = 4;
        const mesh = new three.Mesh(
            new three.CircleGeometry(3.6, 96),
            new three.MeshStandardMaterial({ map: texture, roughness: 0.95, envMapIntensity: 0.4 }),
        );
        mesh.rotation.x = -Math.PI / 2;
        mesh.position.set(0, 0, 0.35);
        mesh.receiveShadow = true;
        return mesh;
    }

    function lights(three, hasCard) {
        const key = new three.SpotLight(0xffe6c8, 95, 9, 0.55, 0.6, 1.6);
        key.position.set(-1.15, 3.5, 2.4);
        key.target.position.set(0, 0.6, 0.35);
        key.castShadow = true;
        key.shadow.mapSize.set(1024, 1024);
        key.shadow.camera.near = 1;
        key.shadow.camera.far = 6;
        key.shadow.bias = -0.0006;
        key.shadow.normalBias = 0.012;
        const rim = new three.DirectionalLight(0x8ab8ff, 1.5);
        rim.position.set(1.6, 1.8, -2.6);
        return [key, key.target, rim, new three.HemisphereLight(0xaab8d6, 0x4a3428, hasCard ? 0.7 : 1.5)];
    }

    // the light of strokes on drums and cymbals
    class Flashes {
        constructor(three, model, style) {
            this.pieces = new Map();
            const colours = Object.fromEntries(
                STATES.map((state) => [state, new three.Color(style.getPropertyValue(`--take-${state}`).trim() || "#fff")]),
            );
            for (const [time, name, velocity, state] of times.strokes) {
                if (!this.pieces.has(name)) this.pieces.set(name, { strokes: [], materials: this.own(model, name) });
                const strength = 0.35 + 0.65 * (velocity / 127);
                this.pieces.get(name).strokes.push({ time, strength, colour: colours[state] });
            }
        }

        // materials of its own for every part of a piece
        own(model, name) {
            const materials = [];
            model.getObjectByName(name)?.traverse((mesh) => {
                if (!mesh.isMesh) return;
                mesh.material = mesh.material.clone();
                materials.push(mesh.material);
            });
            return materials;
        }

        show(time) {
            for (const { strokes, materials } of this.pieces.values()) {
                const stroke = strokes[before(strokes.length, (k) => strokes[k].time, time)];
                const age = stroke ? time - stroke.time : LATEST_S;
                const light = age < LATEST_S ? stroke.strength * Math.exp(-age / FLASH_FADES_S) : 0;
                for (const material of materials) {
                    material.emissiveIntensity = FLASH * light;
                    if (light) material.emissive.copy(stroke.colour);
                }
            }
        }
    }

    // what draws here, as far as the browser tells
    function rendererName() {
        const gl = document.createElement("canvas").getContext("webgl2");
        const told = gl.getExtension("WEBGL_debug_renderer_info");
        const name = String(gl.getParameter(told ? told.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
        gl.getExtension("WEBGL_lose_context")?.loseContext();
        return name;
    }

    class Picture {
        constructor(three, canvas, gltf) {
            this.three = three;
            this.canvas = canvas;
            const hasCard = !SOFTWARE.test(rendererName());
            this.renderer = new three.WebGLRenderer({ canvas, antialias: hasCard });
            this.renderer.toneMapping = three.ACESFilmicToneMapping;
            this.renderer.toneMappingExposure = 1.05;
            this.renderer.shadowMap.enabled = true;
            this.renderer.shadowMap.type = three.PCFShadowMap;
            this.scene = new three.Scene();
            this.scene.background = new three.Color("#0b0d12");
            if (hasCard) this.scene.environment = surroundings(three, this.renderer); // else it takes ten seconds
            this.scene.environmentIntensity = 0.55;
            this.scene.add(floor(three), ...lights(three, hasCard), gltf.scene);
            gltf.scene.traverse((mesh) => {
                if (!mesh.isMesh) return;
                mesh.castShadow = mesh.receiveShadow = true;
                mesh.frustumCulled = false; // a skin's corners are not where its box is
                if (hasCard || mesh.material.metalness < 0.5) return;
                mesh.material.metalness = 0.25; // with nothing to mirror metal is black
                mesh.material.color.multiplyScalar(0.5);
            });
            this.camera = new three.PerspectiveCamera(40, 1.5, 0.05, 30);
            this.orbit = new Orbit(times.views[0]);
            this.mixer = new three.AnimationMixer(gltf.scene);
            this.length = gltf.animations[0]?.duration ?? 0;
            this.actions = gltf.animations.map((clip) => this.mixer.clipAction(clip).setLoop(three.LoopOnce).play());
            this.flashes = new Flashes(three, gltf.scene, getComputedStyle(part));
            this.drawn = "";
            this.pace = { coarse: 0, slow: 0, at: 0 };
            if (!hasCard) this.drawCoarsely(PIXELS_A_POINT.length - 1);
        }

        // draw less finely where pictures follow each other slowly, as without a graphics card
        keepUp(now) {
            const { pace } = this;
            const took = now - pace.at;
            pace.at = now;
            if (took > 1000) return; // the page was hidden, or nothing moved
            pace.slow = took > SLOW_MS ? pace.slow + 1 : 0;
            if (pace.slow < SLOW_FRAMES || pace.coarse === PIXELS_A_POINT.length - 1) return;
            pace.slow = 0;
            this.drawCoarsely(pace.coarse + 1);
        }

        drawCoarsely(level) {
            this.pace.coarse = level;
            this.scene.traverse((one) => {
                if (one.isSpotLight && level > 1) one.castShadow = false;
            });
        }

        // draw unless nothing has changed since the last time
        show(time) {
            const { clientWidth: width, clientHeight: height } = this.canvas;
            if (!width || !height) return;
            const { azimuth, height: above, distance, target, fov } = this.orbit;
            const state = [time, width, height, azimuth, above, distance, target, fov, devicePixelRatio, audio.paused].join();
            if (state === this.drawn) return;
            this.drawn = state;
            this.keepUp(performance.now());
            const most = audio.paused ? Math.max(1, PIXELS_A_POINT[this.pace.coarse]) : PIXELS_A_POINT[this.pace.coarse];
            this.renderer.setPixelRatio(Math.min(devicePixelRatio, most));
            this.renderer.setSize(width, height, false);
            for (const action of this.actions) action.time = Math.min(time, this.length - 1e-4);
            this.mixer.update(0);
            this.flashes.show(time);
            this.orbit.aim(this.camera, width / height);
            this.renderer.render(this.scene, this.camera);
        }
    }

    function follow(picture) {
        const { canvas, orbit } = picture;
        const held = new Map();
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            held.set(event.pointerId, event);
        });
        for (const end of ["pointerup", "pointercancel"]) {
            canvas.addEventListener(end, (event) => held.delete(event.pointerId));
        }
        canvas.addEventListener("pointermove", (event) => {
            const last = held.get(event.pointerId);
            if (!last) return;
            const apart = () => {
                const [one, other] = held.values();
                return Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
            };
            const was = held.size === 2 ? apart() : 0;
            held.set(event.pointerId, event);
            if (held.size === 2) orbit.zoom(was / Math.max(apart(), 1));
            else {
                const [right, down] = [event.clientX - last.clientX, event.clientY - last.clientY];
                orbit.turn(right * ORBIT_RAD_A_PIXEL, down * ORBIT_RAD_A_PIXEL);
            }
        });
        canvas.addEventListener(
            "wheel",
            (event) => {
                if (!event.ctrlKey && document.activeElement !== canvas) return; // the page's own
                event.preventDefault();
                orbit.zoom(Math.exp(event.deltaY * 0.0015));
            },
            { passive: false },
        );
        const keys = {
            ArrowLeft: () => orbit.turn(-ORBIT_RAD_A_KEY, 0),
            ArrowRight: () => orbit.turn(ORBIT_RAD_A_KEY, 0),
            ArrowUp: () => orbit.turn(0, ORBIT_RAD_A_KEY),
            ArrowDown: () => orbit.turn(0, -ORBIT_RAD_A_KEY),
            "+": () => orbit.zoom(0.9),
            "-": () => orbit.zoom(1 / 0.9),
        };
        canvas.addEventListener("keydown", (event) => {
            if (!keys[event.key]) return;
            event.preventDefault();
            keys[event.key]();
        });
        for (const button of part.querySelectorAll("[data-view]")) {
            button.addEventListener("click", () => {
                orbit.take(times.views[Number(button.dataset.view)]);
                for (const other of part.querySelectorAll("[data-view]")) {
                    other.setAttribute("aria-pressed", String(other === button));
                }
            });
        }
    }

    // --- all together ------------------------------------------------------------------------------------------------

    function sayNoPicture() {
        part.classList.add("take-without-picture");
        part.querySelector(".take-no-picture").hidden = false;
    }

    async function picture() {
        const canvas = part.querySelector("canvas");
        if (!document.createElement("canvas").getContext("webgl2")) return null; // asked for here, it complains to nobody
        const three = stationThree;
        const text = part.querySelector(".take-model").textContent.trim();
        const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
        const gltf = await new three.GLTFLoader().parseAsync(bytes.buffer, "");
        const made = new Picture(three, canvas, gltf);
        canvas.addEventListener("webglcontextlost", sayNoPicture);
        follow(made);
        return made;
    }

    function controls() {
        const speed = part.querySelector(".take-speed");
        speed.addEventListener("change", () => {
            audio.playbackRate = Number(speed.value);
        });
        document.addEventListener("keydown", (event) => {
            const busy = event.target.closest?.("input, select, textarea, button, a, summary, audio, [contenteditable]");
            if (event.key !== " " || busy || event.ctrlKey || event.altKey || event.metaKey) return;
            event.preventDefault();
            if (audio.paused) audio.play();
            else audio.pause();
        });
    }

    async function begin() {
        controls();
        const bars = new Bars();
        let drummer = null;
        const frame = () => {
            const time = audio.currentTime;
            bars.show(time, !audio.ended && (time > 0 || !audio.paused));
            drummer?.show(time);
            requestAnimationFrame(frame);
        };
        frame();
        try {
            drummer = await picture();
        } catch (fault) {
            console.warn(`The drummer cannot be shown: ${fault.message}`);
        }
        if (drummer) part.dataset.ready = "picture";
        else {
            part.dataset.ready = "sound";
            sayNoPicture();
        }
    }

    if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", begin);
    else begin();
})();
