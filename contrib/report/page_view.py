# SPDX-License-Identifier: LGPL-2.1-or-later
"""Section of the page with the interactive view, and its script."""
import json
import re

from .html import source


def plain_script(text):
    """A module without its exports, as the body of a function."""
    return re.sub(r"export\s*\{[^}]*\};?\s*$", "", text.strip())


def three_script():
    """three.js and its controls as two constants, no import needed."""
    three = source("three/three.module.min.js").strip()
    exports = re.search(r"export\s*\{([^}]*)\};?\s*$", three)[1]
    names = []
    for part in exports.split(","):
        inner, _, outer = part.strip().partition(" as ")
        names.append(f"{outer or inner}:{inner}")
    controls = source("three/OrbitControls.js")
    needed = re.search(r"import\s*\{([^}]*)\}\s*from\s*'three';", controls)
    body = plain_script(controls.replace(
        needed[0], f"const {{{needed[1].strip()}}} = THREE;"))
    return (f"const THREE=(()=>{{{plain_script(three)}\n"
            f"return{{{','.join(names)}}};}})();\n"
            f"const OrbitControls=(()=>{{{body}\nreturn OrbitControls;}})();\n")


def view_controls(is_plane, is_moved, digs):
    """What stands beside the view."""
    def box(name, label):
        return (f'<label><input type="checkbox" id="show-{name}"> {label}'
                "</label>")

    buttons = {"home": "all"} if is_plane else {
        "home": "all", "inside": "from inside", "top": "from above",
        "below": "from below", "x": "from +x", "y": "from −y"}
    cut = "" if is_plane else (
        '<fieldset><legend>Cut</legend><select id="cut-axis"><option value="">'
        "none</option><option>x</option><option>y</option><option>z</option>"
        '</select> <span id="cut-value"></span><input type="range" id="cut" '
        'min="0" max="100" value="50"><label><input type="checkbox" '
        'id="cut-turn"> keep the other side</label></fieldset>')
    return f"""
<fieldset><legend>Stage</legend><span id="stage-name"></span>
<input type="range" id="stage" min="0" step="1">
<button id="earlier">earlier</button><button id="later">later</button></fieldset>
<fieldset{"" if is_moved else " hidden"}><legend>Displacement times <span id="factor-value"></span></legend>
<input type="range" id="factor" min="0" step="1"></fieldset>
<fieldset><legend>Look</legend>{"".join(
        f'<button id="look-{key}">{text}</button>'
        for key, text in buttons.items())}</fieldset>
{cut}<fieldset><legend>Show</legend>
{box("rock", "rock" if is_plane else "excavation surface" if digs else
     "surface of the rock")}
{box("exposed", "exposed blocks")}{box("hidden", "hidden blocks")}
{box("edges", "outlines")}{box("labels", "numbers of exposed blocks")}</fieldset>
<fieldset><legend>Colours</legend><select id="colouring">
<option value="state">of blocks by factor</option>
{'<option value="displacement">by displacement</option>' if is_moved else ""}
<option value="stress">by major principal stress</option>
<option value="joint">by joint</option></select>
<div id="states"></div><div id="largest"></div></fieldset>
<fieldset><legend>Joints as in the scene</legend><div id="groups"></div></fieldset>"""


def view_section(run, packed):
    """The interactive view with its data."""
    if not packed:
        return ""
    meta, data = packed
    hint = ("Drag to move, wheel to zoom." if run.is_plane else
            "Drag to turn, right button or shift to move, wheel to zoom. Rock "
            "is seen from " + ("the excavation's" if run.digs() else "its free")
            + " side only.")
    meta_text = json.dumps(meta).replace("<", "\\u003c")
    script = (three_script() + source("view.js")).replace("</script",
                                                          "<\\/script")
    return f"""<h2 id=in-space>{'View' if run.is_plane else 'View in space'}</h2>
<p class=faint>{hint} Click on a block for its row in the table.</p>
<div id="view"><div id="canvas"><div id="labels"></div><div id="scale"></div>
<div id="chosen" hidden></div></div>
<div id="controls">{view_controls(run.is_plane, run.takes_steps(), run.digs())}</div></div>
<script type="application/json" id="view-meta">{meta_text}</script>
<script type="text/plain" id="view-data">{data}</script>
<script type="module">
{script}
</script>"""
