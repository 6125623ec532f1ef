"""Outputs and effects described for people and clients."""

from optimizer.effects.registry import EFFECTS, effects_of, inputs_of
from optimizer.outputs.registry import OUTPUTS
from schemas.answer.effects import EffectCatalogue, EffectEntry, OutputEntry


def catalogue() -> EffectCatalogue:
    """Every output with the effects and inputs behind it, and every effect."""
    return EffectCatalogue(
        outputs=tuple(
            OutputEntry(
                name=name, meaning=output.meaning, needs=tuple(effects_of(output.needs)), inputs=inputs_of(output.needs)
            )
            for name, output in OUTPUTS.items()
        ),
        effects=tuple(
            EffectEntry(name=name, meaning=effect.meaning, needs=effect.needs, inputs=effect.inputs)
            for name, effect in EFFECTS.items()
        ),
    )
