# SPDX-License-Identifier: LGPL-2.1-or-later
"""What limit equilibrium says of blocks, alone and once others have gone."""
import math

from .words import demand_of, mode_in_words, number


def once_gone(limit):
    """Factor, mode and the words for what has gone, of a block that is safer
    as long as others stay; or None."""
    then = (limit or {}).get("once_gone")
    if not then:
        return None
    ids = ", ".join(str(block) for block in then["blocks"])
    gone = f"block {ids} has" if len(then["blocks"]) == 1 else f"blocks {ids} have"
    return then["value"], then["mode"], f"{gone} gone"


def own_factor(limit):
    """The factor of a block while all others stay; infinite: stable."""
    return (limit or {}).get("value", math.inf)


def last_factor(limit):
    """The factor of a block alone, or the lower one once others have gone."""
    then = once_gone(limit)
    return min(own_factor(limit), then[0] if then else math.inf)


def follows_others(limit):
    """Whether a block fails, but only once others have gone."""
    return last_factor(limit) < 1. <= own_factor(limit)


def force_of(demand):
    """The force that a demand for support asks for; infinite: none does."""
    return demand.get("force", math.inf) if demand else 0.


def least_limit(limits):
    """The result of the stage in which a block is most dangerous, or None.

    The least factor of its own where that is below 1, else the least once
    others have gone; of equal ones that which asks for most support, then the
    last."""
    def order_of(limit):
        own = own_factor(limit)
        return (own if own < 1. else math.inf, last_factor(limit),
                -force_of(demand_of(limit)))
    return min(reversed(limits), key=order_of) if limits else None


def factor_by_statics(limit):
    """What limit equilibrium says, where it is all that was asked for."""
    if not limit:
        return None
    value = last_factor(limit)
    return ({"outcome": "value", "value": value} if math.isfinite(value) else
            {"outcome": "stable"})


def limit_in_words(limit):
    """What limit equilibrium says, in words."""
    if not limit or limit.get("outcome") != "stable" and "value" not in limit:
        return "–"
    text = ("stable" if limit.get("outcome") == "stable" else
            factor_in_words(limit["value"], limit.get("mode")))
    then = once_gone(limit)
    if then:
        text += f"; {factor_in_words(*then[:2])} once {then[2]}"
    return text


def factor_in_words(value, mode):
    """A factor, and that it is that of a block which falls."""
    return number(value) + (" (falls)" if mode == "falling" else "")


def statics_in_words(row):
    """The same of a block's row, where it is not critical, too."""
    if row["passed"] is None:
        return limit_in_words(row["limit"])
    return f"at least {number(row['passed'])}, not critical"


def mode_by_statics(limit):
    """How a block fails by limit equilibrium, as people say it."""
    then = once_gone(limit)
    if then and limit.get("outcome") == "stable":
        return f"{mode_in_words(then[1])}, once others have gone"
    return mode_in_words((limit or {}).get("mode"))


def passed_factor(run, block):
    """The factor that an exposed block without results has at least, or None.

    Of blocks that are not critical limit equilibrium writes no result."""
    if run.entries.get("Safety factor/Blocks") != "critical" or run.entries.get(
            "Contact/Method") == "none" or {
                "safety_factor", "limit_equilibrium"} & set(block):
        return None
    asked = [name.strip() for name in run.entries.get(
        "Safety factor/Stages", "").split(",") if name.strip()]
    kinds = block.get("class") or [""]  # the last holds for later stages
    is_judged = any(
        kinds[min(k, len(kinds) - 1)] == "exposed"
        for k, name in enumerate(run.stages, 2) if not asked or name in asked)
    return next(iter(run.numbers("Safety factor/Critical factor")),
                None) if is_judged else None
