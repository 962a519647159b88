"""The drummer's part in a battle: whoever the opponent is plays what the battle asks for."""

from station.practice.battle.improvising.improvise import improvised
from station.practice.battle.improvising.time_keeping import time_keeping
from station.practice.battle.opponents.opponent import find_opponent
from station.practice.battle.phrase import Phrase
from station.practice.battle.phrase_request import Asked, PhraseRequest
from station.practice.battle.repeating.phrase_to_repeat import phrase_to_repeat


def drummed(request: PhraseRequest) -> Phrase:
    """The phrase that is asked for; the same request is the same phrase."""
    opponent, ground = find_opponent(request.rules.opponent), request.rules.ground
    match request.asked:
        case Asked.TO_REPEAT:
            assert request.step is not None, "what is to be repeated has a step"
            return phrase_to_repeat(opponent, ground, request.step, request.rng)
        case Asked.TO_ANSWER:
            return improvised(opponent, ground, request.bars, request.heard, request.said, request.rng)
        case Asked.TIME:
            return time_keeping(opponent, ground, request.bars, request.rng)
