"""A state saved to a file after five days and restored in another instance, which then goes on in two ways."""

from fmu import Fmu
from picture import finish, folders, panels

dist, pictures = folders(__doc__)
DAY_S, STEP_S = 86400.0, 600.0


def advance(plant, days):
    """Times in days and X momentum of the days to come."""
    rows = []
    for _ in range(round(days * DAY_S / STEP_S)):
        plant.step(STEP_S)
        rows.append((plant.time / DAY_S, plant.get("momentum.body[1]")))
    return rows


with Fmu(dist / "MomentumPlant.fmu") as plant:
    first = advance(plant, 5)
    (pictures / "five-days.state").write_bytes(plant.save())
    original = advance(plant, 5)

blob = (pictures / "five-days.state").read_bytes()
with Fmu(dist / "MomentumPlant.fmu") as plant:
    plant.restore(blob, 5 * DAY_S)
    restored = advance(plant, 5)
    plant.restore(blob, 5 * DAY_S)
    plant.set("spacecraft.centerOfMass", [0.0, 0.0, -0.0508])
    moved = advance(plant, 5)

same = "every bit the same" if restored == original else "different"
print(f"{len(blob)} bytes; restored: {same}, X momentum after ten days {restored[-1][1]!r} N.m.s; "
      f"with the centre of mass moved {moved[-1][1]:.3f} N.m.s")

figure, (axis,) = panels(1, "time [d]")
axis.plot(*zip(*first), label="first five days")
axis.plot(*zip(*restored), label="restored")
axis.plot(*zip(*moved), label="restored, centre of mass 5.08 cm lower")
axis.set_ylabel("X momentum [N.m.s]")
finish(figure, pictures / "save_restore.svg")
