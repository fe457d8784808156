#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the floors of the library: docs/pictures/floors.svg and .png, from scripts/floors.tsv and the #include lines.

    scripts/draw_floors.py [--check]     --check: draw nothing, fail if the picture in docs/ shows something else

Floors are rows and folders are rooms. Folders of one name that stand on several floors, few on each (tight/...), are a
tower at the left; the other rooms of a floor share what is left of it. An arrow runs from a folder to one that it includes. Left
out are arrows that follow from others (where a includes b and b includes c, that from a to c), and those to the two
lowest floors, which nearly every folder includes.
"""
import sys
import textwrap
from xml.etree import ElementTree

import check_includes

PICTURES = check_includes.ROOT / "docs/pictures"
INK, FAINT, LINE = "#23272e", "#5c6470", "#0072B2"
FILLS = ["#eef4f9", "#f8f3e8"]  # of floors in turn
WIDTH, TOWER, GAP, ROW, ROOM = 17.6, 2.7, 0.16, 1.0, 0.7
MOST_IN_TOWER = 2  # rooms of a tower on one floor


def below_all(arrows, folder):
    """All folders that one includes, by way of others or not."""
    direct = [to for source, to in arrows if source == folder]
    return set(direct).union(*(below_all(arrows, to) for to in direct))


def drawn_arrows(floors, arrows):
    """(from, to), without those that follow from others and those to the two lowest floors."""
    def follows(source, to):
        return any(to in below_all(arrows, via) for start, via in arrows if start == source)
    return [(source, to) for source in floors for to in floors
            if (source, to) in arrows and floors[to][0] > 2 and not follows(source, to)]


def is_tower(stands_on):
    """Whether folders of one name are a tower; their floors are given."""
    return len(set(stands_on)) > 1 and all(stands_on.count(floor) <= MOST_IN_TOWER for floor in stands_on)


def place_rooms(floors):
    """folder -> (left, right, floor) of its room."""
    rows = {}
    for folder, (floor, _) in floors.items():
        rows.setdefault(floor, []).append(folder)
    towers = {name for name in {folder.split("/")[0] for folder in floors if "/" in folder}
              if is_tower([floor for folder, (floor, _) in floors.items() if folder.split("/")[0] == name])}
    rooms = {}
    for floor, folders in rows.items():
        inside = [f for f in folders if f.split("/")[0] in towers]
        others = [f for f in folders if f not in inside]
        for i, folder in enumerate(inside):
            rooms[folder] = (i * (TOWER + GAP), i * (TOWER + GAP) + TOWER, floor)
        left = len(inside) * (TOWER + GAP) + GAP if inside else 0.0
        width = (WIDTH - left + GAP) / len(others) if others else 0.0
        for i, folder in enumerate(others):
            rooms[folder] = (left + i * width, left + (i + 1) * width - GAP, floor)
    return rooms


def route(rooms, source, to, source_slot, to_slot):
    """The corners of an arrow. Slots are fractions of the rooms' widths at which it leaves and arrives."""
    (left, right, floor), (to_left, to_right, to_floor) = rooms[source], rooms[to]
    bottom, top = floor * ROW, to_floor * ROW + ROOM
    x = left + source_slot * (right - left)
    x_to = to_left + to_slot * (to_right - to_left)
    if to_left < x < to_right and right - left < to_right - to_left:
        return [(x, bottom), (x, top)]
    if left < x_to < right:
        return [(x_to, bottom), (x_to, top)]
    beside = any(other[0] > right and other[2] == floor for other in rooms.values())
    if right > TOWER or beside or floor == to_floor + 1:
        turn = bottom - (ROW - ROOM) * (0.2 + 0.5 * source_slot)
        return [(x, bottom), (x, turn), (x_to, turn), (x_to, top)]
    y = bottom + 0.5 * ROOM  # out of the tower's side, then down
    return [(right, y), (x_to, y), (x_to, top)]


def slots(rooms, arrows, end):
    """arrow -> where it meets the room at that end, as a fraction; neighbours in the order of their other ends."""
    result = {}
    for folder in rooms:
        own = [a for a in arrows if a[end] == folder]
        own.sort(key=lambda a: sum(rooms[a[1 - end]][:2]))
        for i, arrow in enumerate(own):
            result[arrow] = (i + 1) / (len(own) + 1) - 0.03 * (rooms[folder][2] % 3)  # floors apart
    return result


def state(floors, arrows):
    """What the picture shows, as text: kept in the SVG, so that an old picture is found out."""
    lines = [f"{floor} {folder}: {purpose}" for folder, (floor, purpose) in floors.items()]
    return "; ".join(lines + [f"{a} -> {b}" for a, b in drawn_arrows(floors, arrows)])


def draw(floors, arrows):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.patches import FancyBboxPatch

    plt.rcParams.update({"font.family": "DejaVu Sans", "text.color": INK, "svg.fonttype": "none", "svg.hashsalt": "floors"})
    rooms, shown = place_rooms(floors), drawn_arrows(floors, arrows)
    height = max(floor for floor, _ in floors.values()) + 1
    figure, axes = plt.subplots(figsize=(WIDTH * 0.86, height * 0.78))
    axes.set(xlim=(-0.7, WIDTH + 0.1), ylim=(0.85, height + 0.4))
    axes.axis("off")
    for floor in range(1, height):
        axes.text(-0.35, floor * ROW + ROOM / 2, str(floor), ha="center", va="center", color=FAINT, fontsize=10)
    for folder, (left, right, floor) in rooms.items():
        axes.add_patch(FancyBboxPatch((left, floor * ROW), right - left, ROOM, zorder=3, linewidth=0.9,
                                      boxstyle="round,pad=0,rounding_size=0.06", edgecolor="#8a919c",
                                      facecolor=FILLS[floor % 2]))
        purpose = textwrap.wrap(floors[folder][1], max(19, int((right - left) * 13.3)))
        name_top = floor * ROW + ROOM - (0.07 if len(purpose) > 1 else 0.12)
        axes.text((left + right) / 2, name_top, folder, ha="center", va="top", fontsize=10, fontweight="bold",
                  zorder=4)
        axes.text((left + right) / 2, name_top - 0.25, "\n".join(purpose), ha="center", va="top",
                  fontsize=7.2, color=INK, linespacing=1.15, zorder=4)
    leave, arrive = slots(rooms, shown, 0), slots(rooms, shown, 1)
    for arrow in shown:
        corners = route(rooms, *arrow, leave[arrow], arrive[arrow])
        axes.plot(*zip(*corners[:-1], corners[-1]), color=LINE, linewidth=1.2, zorder=2, solid_joinstyle="round")
        axes.annotate("", corners[-1], xytext=(corners[-1][0], corners[-1][1] + 0.1), zorder=2,
                      arrowprops={"arrowstyle": "-|>", "color": LINE, "shrinkA": 0, "shrinkB": 0, "linewidth": 1.2})
    axes.text(-0.35, height + 0.12, "floor", ha="center", fontsize=8, color=FAINT)
    axes.text(0.1, height + 0.12, "Folders of openvdb_spheretree/. An arrow: includes. It may pass behind rooms; arrows that "
              "follow from others, and those to voxel and base, are left out.", fontsize=8, color=FAINT)
    PICTURES.mkdir(parents=True, exist_ok=True)
    figure.savefig(PICTURES / "floors.svg", bbox_inches="tight", pad_inches=0.06,
                   metadata={"Date": None, "Description": state(floors, arrows)})
    figure.savefig(PICTURES / "floors.png", bbox_inches="tight", pad_inches=0.06, dpi=110)


def is_old(floors, arrows):
    """Whether the picture shows something else; says so."""
    picture = ElementTree.parse(PICTURES / "floors.svg")
    if state(floors, arrows) in (element.text for element in picture.iter()):
        return False
    print("docs/pictures/floors.svg shows an older state of the house: run scripts/draw_floors.py", file=sys.stderr)
    return True


def main():
    floors = check_includes.read_floors()
    arrows, _ = check_includes.check(floors)
    if "--check" in sys.argv[1:]:
        return int(is_old(floors, arrows))
    draw(floors, arrows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
