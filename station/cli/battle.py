"""`station battle`: a battle against the drummer or among people, in the terminal, or with virtual players."""

from contextlib import ExitStack

from station.app.sessions.session_checks import check_settings
from station.app.settings.settings_store import SettingsStore
from station.cli.battling.battle_options import BattleOptions, battle_rules
from station.cli.battling.battle_video import check_film, film_battle
from station.cli.battling.meant_battle import meant_battle
from station.cli.console import print_json, say, write
from station.cli.input.caught_up import caught_up
from station.cli.options.device_option import wanted_kits
from station.cli.options.option_fields import Command
from station.cli.options.virtual_students import whose
from station.core.errors import BadInput, DeviceError, StationError
from station.core.settings import Settings
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.records.battle_document import battle_document
from station.practice.battle.records.battle_folder import BattleFolder, battles_cut_off, kept_battle, recovered_battle
from station.practice.battle.records.battle_report import battle_report
from station.practice.history.student_history import StudentHistory

STAND_IN = "intermediate,seed=1"
"""Who plays where there is no kit, or where nobody is to be waited for."""


def run(options: BattleOptions) -> int:
    """Play, or judge again."""
    check_film(options.video)
    if options.judge_again is not None:
        settings = _wanted(options)
        result = meant_battle(options.judge_again, options.level, settings)
        _print(result, options)
        film_battle(result, options.video, settings)
        return 0
    settings = _wanted(options)
    if options.recover is not None:
        result = recovered_battle(options.recover)
        _leave(BattleFolder(options.recover, StudentHistory.of(settings), is_new=False), result, options)
        film_battle(result, options.video, settings)
        return 0
    if options.network.is_wanted:
        return _over_network(options, settings)
    specs = _virtual_players(options, settings)
    settings = caught_up(whose(settings, options.student) if specs else settings)
    rules = battle_rules(options, settings, specs)
    if not specs:
        _check_ports(rules)
    with BattleFolder.make(options.report, settings, rules.opponent) as folder:
        if specs:
            fault = _virtual(rules, specs, folder, options)
        else:
            _say_what_was_cut_off(settings)
            fault = _live(rules, settings, folder, options)
    if fault is not None:
        raise fault
    if options.video.film is not None and folder.capture.exists():
        film_battle(kept_battle(folder.path), options.video, settings)
    return 0


def _over_network(options: BattleOptions, settings: Settings) -> int:
    from station.cli.battling.network_battle import NetworkBattle, list_hosts, play_over_network
    from station.cli.battling.network_options import LIST

    if options.network.join == LIST:
        list_hosts(options.network)
        return 0
    if len(options.players) > 1:
        raise BadInput("--players", f"{len(options.players)}", "one plays at each station of a network")
    specs = _virtual_players(options, settings)
    settings = caught_up(whose(settings, options.student) if specs else settings)
    rules = battle_rules(options, settings, specs)
    with BattleFolder.make(options.report, settings, "network") as folder:
        spec = specs[0] if specs else None
        fault = play_over_network(NetworkBattle(rules, settings, options.network, spec, folder, options.json))
    if fault is not None:
        raise fault
    return 0


def _virtual(
    rules: BattleRules, specs: tuple[str, ...], folder: BattleFolder, options: BattleOptions
) -> StationError | None:
    from station.practice.battle.battle import Battle
    from station.practice.battle.drummed import drummed
    from station.practice.headless.virtual_battle import battle_virtually
    from station.practice.headless.virtual_performers import virtual_performers

    battle = Battle(rules, drummed)
    fault = battle_virtually(battle, virtual_performers(rules, specs), folder.capture)
    _leave(folder, battle.result(), options)
    return fault


def _live(rules: BattleRules, settings: Settings, folder: BattleFolder, options: BattleOptions) -> StationError | None:
    from station.cli.battling.battle_terminal import battle_in_terminal

    with ExitStack() as until_saved:
        live = battle_in_terminal(rules, settings, folder.capture, until_saved)
        say("")
        _leave(folder, live.result, options)
    return live.fault


def _leave(folder: BattleFolder, result: BattleResult, options: BattleOptions) -> None:
    """Keep a battle and print its report; what the disk refuses is said after the report was printed.

    One that nobody played is not kept.
    """
    if not result.is_played:
        folder.discard()
        if options.json:
            print_json(battle_document(result))
        say("nobody has played a stroke: the battle is not kept")
        return
    refused, unkept = None, None
    try:
        unkept = folder.write(result)
    except StationError as fault:
        refused = fault
    _print(result, options)
    if unkept is not None:
        say(unkept)
    if refused is not None:
        raise refused
    say(f"report   {folder.report}")


def _print(result: BattleResult, options: BattleOptions) -> None:
    if options.json:
        print_json(battle_document(result))
    else:
        write(battle_report(result), end="", flush=True)


def _virtual_players(options: BattleOptions, settings: Settings) -> tuple[str, ...]:
    """Who plays instead of people, a line each; none where people play, as they do on kits that are named."""
    specs, players = tuple(options.virtual_student), max(len(options.players), 1)
    if not specs and any(player.device for player in options.players):
        return ()
    if not specs and (options.headless or not _is_kit_there(settings.kit)):
        if not options.headless:
            say("no kit here: a virtual student plays instead")
        specs = (STAND_IN,)
    if specs and len(specs) not in (1, players):
        raise BadInput("--virtual-student", f"{len(specs)} of them", f"expected 1 or {players}")
    return specs * players if len(specs) == 1 else specs


def _check_ports(rules: BattleRules) -> None:
    """Raise `DeviceError` where a kit that was named is not there."""
    from station.devices.device_ports import devices_there, no_device, parse_device

    named = {player: parse_device(player.device) for player in rules.players if player.device}
    absent = tuple(request for request in named.values() if not devices_there((request,)))
    if absent:
        wanted = ", ".join(f"{player.name} on {player.device!r}" for player in named)
        raise DeviceError(f"kits are named for this battle ({wanted}): {no_device(absent)}")


def _is_kit_there(wanted: str) -> bool:
    from station.devices.device_ports import devices_there, parse_devices

    return bool(devices_there(parse_devices(wanted)))


def _say_what_was_cut_off(settings: Settings) -> None:
    for folder in battles_cut_off(StudentHistory.of(settings))[:1]:
        say(f"a battle was cut off before it was judged: {folder.name}; station battle --recover {folder} judges it")


def _wanted(options: BattleOptions) -> Settings:
    """The settings with what the command line says instead for this once."""
    kits = tuple(player.device for player in options.players if player.device) or options.device
    said = {**options.sound.settings(), "kit": wanted_kits(kits, SettingsStore().now.kit)}
    if options.student is not None:
        said["student"] = options.student
    elif options.players:
        said["student"] = options.players[0].name
    store = SettingsStore(said=said, source="battle")
    check_settings(store.now)
    return store.now


COMMAND = Command(BattleOptions, run)
