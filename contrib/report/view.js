// SPDX-License-Identifier: LGPL-2.1-or-later
// The interactive view: surfaces of blocks and rock by stage, to click on.
// THREE and OrbitControls stand before this in the page; the data, in the
// elements "view-meta" and "view-data".

const SHADES = ['#fdf6e3', '#f4c430', '#2c9f9f', '#1b2a6b'];
const element = (name) => document.getElementById(name);
const fail = (sentence) => {
  element('canvas').innerHTML = `<p style="padding:20px">${sentence}</p>`;
  element('controls').hidden = true;
};

async function read() {
  const meta = JSON.parse(element('view-meta').textContent);
  const packed = Uint8Array.from(atob(element('view-data').textContent.trim()),
                                 (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(
    new DecompressionStream('deflate'));
  const bytes = await new Response(stream).arrayBuffer();
  const kinds = {f4: Float32Array, u4: Uint32Array, u2: Uint16Array,
                 i4: Int32Array, u1: Uint8Array};
  const data = {};
  for (const [name, [kind, offset, length]] of Object.entries(meta.arrays))
    data[name] = new kinds[kind](bytes, offset, length);
  return {meta, data};
}

class View {
  constructor(meta, data) {
    Object.assign(this, {meta, data, chosen: 0, exaggeration: meta.exaggeration,
                         colouring: 'state', state: meta.opens});
    this.shows = {rock: true, exposed: true, hidden: meta.plane, edges: true,
                  labels: true, groups: new Set()};
    const exposed = Object.values(meta.blocks).filter((b) => b.exposed).length;
    const hidden = Object.keys(meta.blocks).length - exposed;
    if (!exposed || hidden <= 12) this.shows.hidden = true;
    this.make_scene();
    this.make_meshes();
    this.make_joints();
    this.make_labels();
    this.make_controls();
    this.look('home');
    this.update();
    new ResizeObserver(() => this.resize()).observe(element('canvas'));
  }

  make_scene() {
    const {meta} = this;
    this.renderer = new THREE.WebGLRenderer({antialias: true,
                                             preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.localClippingEnabled = true;
    this.canvas = element('canvas');
    this.canvas.prepend(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xffffff);
    this.low = new THREE.Vector3(...meta.box[0]);
    this.high = new THREE.Vector3(...meta.box[1]);
    this.size = this.high.distanceTo(this.low);
    this.up = new THREE.Vector3(...meta.up);
    if (meta.plane) {
      this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -10 * this.size,
                                                 10 * this.size);
    } else {
      this.camera = new THREE.PerspectiveCamera(45, 1, this.size / 2000,
                                                30 * this.size);
      this.camera.up.copy(this.up);
      this.scene.add(new THREE.HemisphereLight(0xffffff, 0xc8c4bc, 2.6));
      const lamp = new THREE.DirectionalLight(0xffffff, 1.1);
      lamp.position.set(-0.6, 0.5, 1);
      this.camera.add(lamp);
      this.scene.add(this.camera);
    }
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    if (meta.plane) {
      this.controls.enableRotate = false;
      this.controls.screenSpacePanning = true;
      this.controls.mouseButtons.LEFT = THREE.MOUSE.PAN;
      this.controls.touches.ONE = THREE.TOUCH.PAN;
    }
    this.controls.addEventListener('change', () => this.render());
    this.cut = new THREE.Plane(new THREE.Vector3(0, -1, 0), 1e9);
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      down = [event.clientX, event.clientY];
    });
    this.canvas.addEventListener('click', (event) => {
      if (down && Math.hypot(event.clientX - down[0],
                             event.clientY - down[1]) < 5)
        this.pick(event);
    });
  }

  material(options) {
    const kind = this.meta.plane ? THREE.MeshBasicMaterial
                                 : THREE.MeshLambertMaterial;
    return new kind({vertexColors: true, clippingPlanes: [this.cut],
                     polygonOffset: true, polygonOffsetFactor: 1,
                     polygonOffsetUnits: 1,
                     ...(this.meta.plane ? {} : {flatShading: true}),
                     ...options});
  }

  // Rock is drawn from its free side only, so that one looks into a cavern
  // from outside; blocks from both sides.
  make_meshes() {
    const both = {side: THREE.DoubleSide};
    this.meshes = {};
    const rock = this.meta.plane ? both : {side: THREE.FrontSide};
    for (const [kind, options] of [['rock', rock], ['block', both]]) {
      const mesh = new THREE.Mesh(new THREE.BufferGeometry(),
                                  this.material(options));
      mesh.frustumCulled = false;
      this.scene.add(mesh);
      this.meshes[kind] = mesh;
    }
    this.lines = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({vertexColors: true, transparent: true,
                                   opacity: this.meta.plane ? 0.75 : 0.55,
                                   clippingPlanes: [this.cut]}));
    this.lines.frustumCulled = false;
    this.scene.add(this.lines);
    this.outline = new THREE.LineSegments(
      new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({color: 0x000000, depthTest: false}));
    this.outline.frustumCulled = false;
    this.outline.renderOrder = 5;
    this.scene.add(this.outline);
  }

  make_joints() {
    const {joint_points: points, joint_group: group} = this.data;
    this.joints = [];
    if (!points) return;
    const n = this.meta.plane ? 2 : 3;
    this.meta.groups.forEach((one, k) => {
      const mine = [];
      for (let i = 0; i < group.length; ++i)
        if (group[i] === k)
          mine.push(...points.subarray(3 * n * i, 3 * n * (i + 1)));
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(
        new Float32Array(mine), 3));
      const joint = this.meta.plane
        ? new THREE.LineSegments(geometry, new THREE.LineBasicMaterial(
            {color: one.colour, depthTest: false, transparent: true}))
        : new THREE.Mesh(geometry, new THREE.MeshBasicMaterial(
            {color: one.colour, transparent: true, opacity: 0.22,
             side: THREE.DoubleSide, depthWrite: false,
             clippingPlanes: [this.cut]}));
      joint.renderOrder = 3;
      joint.visible = false;
      this.scene.add(joint);
      this.joints.push(joint);
    });
  }

  make_labels() {
    this.labels = {};
    for (const [number, block] of Object.entries(this.meta.blocks)) {
      if (!block.exposed) continue;
      const span = document.createElement('span');
      span.textContent = number;
      element('labels').append(span);
      this.labels[number] = span;
    }
  }

  // Positions of all vertices in the state, displacements exaggerated.
  move() {
    const {places} = this.data, moved = this.data[`moved_${this.state}`];
    const factor = this.exaggeration * this.meta.scale;
    const half = THREE.DataUtils.fromHalfFloat;
    this.positions ??= new Float32Array(places.length);
    this.lengths ??= new Float32Array(places.length / 3);
    for (let i = 0; i < places.length; i += 3) {
      const x = half(moved[i]), y = half(moved[i + 1]), z = half(moved[i + 2]);
      this.positions[i] = places[i] + factor * x;
      this.positions[i + 1] = places[i + 1] + factor * y;
      this.positions[i + 2] = places[i + 2] + factor * z;
      this.lengths[i / 3] = this.meta.scale * Math.hypot(x, y, z);
    }
  }

  is_shown(block) {
    if (!block) return this.shows.rock;
    return this.meta.blocks[block]?.exposed ? this.shows.exposed
                                            : this.shows.hidden;
  }

  // Triangles seen in the state, with colours of their own.
  update() {
    this.move();
    const {triangles, triangle_seen: seen, triangle_block: block,
           triangle_group: group} = this.data;
    const bit = 1 << this.state, parts = {rock: [], block: []};
    this.largest = 0;
    for (let t = 0; t < block.length; ++t) {
      if (!(seen[t] & bit) || !this.is_shown(block[t])) continue;
      parts[block[t] ? 'block' : 'rock'].push(t);
      for (let c = 0; c < 3; ++c)
        this.largest = Math.max(this.largest,
                                this.lengths[triangles[3 * t + c]]);
    }
    this.middles = {};
    for (const [kind, list] of Object.entries(parts))
      this.fill(this.meshes[kind], list, triangles, block, group);
    this.update_lines(bit);
    this.joints.forEach((joint, k) => {
      joint.visible = this.shows.groups.has(k);
    });
    element('states').hidden = this.colouring !== 'state';
    const range = this.colouring === 'displacement'
      ? `0 to ${(1e3 * this.largest).toPrecision(3)} mm`
      : this.colouring === 'stress' && this.meta.stress
      ? this.meta.stress.map((s) => (1e-6 * s).toPrecision(3)).join(' to ')
        + ' MPa, pressed: +' : '';
    element('largest').innerHTML = range && `<div style="height:12px;
      background:linear-gradient(90deg,${SHADES})"></div>${range}`;
    this.render();
  }

  fill(mesh, list, triangles, block, group) {
    const place = new Float32Array(9 * list.length);
    const colour = new Float32Array(9 * list.length);
    const paint = new THREE.Color(), white = new THREE.Color(0xffffff);
    mesh.userData.blocks = list.map((t) => block[t]);
    list.forEach((t, n) => {
      const number = block[t];
      for (let c = 0; c < 3; ++c) {
        const v = triangles[3 * t + c];
        for (let d = 0; d < 3; ++d)
          place[9 * n + 3 * c + d] = this.positions[3 * v + d];
        if (number && number in this.labels) {
          const sum = this.middles[number] ??= [0, 0, 0, 0];
          for (let d = 0; d < 3; ++d) sum[d] += this.positions[3 * v + d];
          ++sum[3];
        }
        this.colour_of(paint, white, number, group[t], v, t);
        paint.toArray(colour, 9 * n + 3 * c);
      }
    });
    mesh.geometry.dispose();
    mesh.geometry = new THREE.BufferGeometry();
    mesh.geometry.setAttribute('position',
                               new THREE.BufferAttribute(place, 3));
    mesh.geometry.setAttribute('color', new THREE.BufferAttribute(colour, 3));
  }

  colour_of(paint, white, number, group, vertex, triangle) {
    const {meta} = this, stress = this.data[`stress_${this.state}`];
    const is_stress = this.colouring === 'stress' && stress;
    if (this.colouring === 'displacement' || is_stress) {
      // of each quadrilateral the two triangles are half the list apart
      const share = is_stress ? stress[triangle % stress.length] / 255
        : this.largest ? this.lengths[vertex] / this.largest : 0;
      const at = Math.min(share, 0.9999) * 3;
      paint.set(SHADES[Math.floor(at)]).lerp(
        new THREE.Color(SHADES[Math.floor(at) + 1]), at % 1);
    } else if (this.colouring === 'joint' && group) {
      paint.set(meta.groups[group - 1]?.colour ?? '#999999');
    } else if (number && meta.blocks[number]) {
      paint.set(meta.colours[meta.blocks[number].state][0]);
      if (!meta.blocks[number].exposed) paint.lerp(white, 0.6);
    } else {
      paint.set(meta.plane ? '#eceae4' : '#d8d3c8');
    }
    if (number && number === this.chosen) paint.lerp(new THREE.Color(
      0xffee00), 0.45);
  }

  update_lines(bit) {
    const {lines, line_seen: seen, line_block: block,
           line_group: group} = this.data;
    const all = [], mine = [], colours = [], dark = new THREE.Color(0x222222);
    const groups = this.meta.groups.map((g) => new THREE.Color(g.colour));
    for (let i = 0; i < seen.length; ++i) {
      if (!(seen[i] & bit) || !(this.is_shown(block[i]))) continue;
      const to = block[i] && block[i] === this.chosen ? mine : null;
      const colour = this.colouring === 'joint' && groups[group[i] - 1] || dark;
      for (const v of [lines[2 * i], lines[2 * i + 1]]) {
        if (this.shows.edges) colours.push(colour.r, colour.g, colour.b);
        for (let d = 0; d < 3; ++d) {
          const x = this.positions[3 * v + d];
          if (this.shows.edges) all.push(x);
          if (to) to.push(x);
        }
      }
    }
    for (const [one, points] of [[this.lines, all], [this.outline, mine]]) {
      one.geometry.dispose();
      one.geometry = new THREE.BufferGeometry();
      one.geometry.setAttribute('position', new THREE.BufferAttribute(
        new Float32Array(points), 3));
    }
    this.lines.geometry.setAttribute('color', new THREE.BufferAttribute(
      new Float32Array(colours), 3));
  }

  render() {
    this.renderer.render(this.scene, this.camera);
    const wide = this.canvas.clientWidth, high = this.canvas.clientHeight;
    const put = [];
    for (const number of this.meta.order) {
      const span = this.labels[number];
      if (!span) continue;
      const sum = this.middles?.[number];
      const point = sum && new THREE.Vector3(sum[0], sum[1], sum[2])
        .divideScalar(sum[3]).project(this.camera);
      span.hidden = !point || !this.shows.labels || Math.abs(point.z) > 1;
      if (span.hidden) continue;
      const x = (0.5 + 0.5 * point.x) * wide, y = (0.5 - 0.5 * point.y) * high;
      // labels in the order of danger; one that would cover another is not put
      span.hidden = put.some(([u, v]) => Math.abs(u - x) < 26
                                         && Math.abs(v - y) < 14);
      if (span.hidden) continue;
      put.push([x, y]);
      span.style.left = `${x}px`;
      span.style.top = `${y}px`;
    }
    this.write_scale(wide);
  }

  write_scale(wide) {
    if (!this.meta.plane) return;
    const metres = (this.camera.right - this.camera.left) / this.camera.zoom;
    const target = 0.16 * metres, power = 10 ** Math.floor(Math.log10(target));
    const length = [5, 2, 1].find((f) => f * power <= target) * power;
    element('scale').innerHTML = `<div style="border:1px solid #333;
      border-top:0;height:5px;width:${length / metres * wide}px"></div>
      ${+length.toPrecision(1)} m`;
  }

  resize() {
    const wide = this.canvas.clientWidth, high = this.canvas.clientHeight;
    if (!wide || !high) return;
    this.renderer.setSize(wide, high);
    if (this.meta.plane) {
      const box = [this.high.x - this.low.x, this.high.y - this.low.y];
      const half = 0.52 * Math.max(box[1], box[0] * high / wide);
      Object.assign(this.camera, {top: half, bottom: -half,
                                  left: -half * wide / high,
                                  right: half * wide / high});
    } else {
      this.camera.aspect = wide / high;
    }
    this.camera.updateProjectionMatrix();
    this.render();
  }

  // Where the camera stands: about everything, on one side, or in the tunnel.
  look(from) {
    const {controls, camera, meta, up} = this;
    const middle = this.low.clone().add(this.high).multiplyScalar(0.5);
    const sides = {home: [0.7, -1, 0.5], x: [1, 0, 0], y: [0, -1, 0],
                   top: [0, -0.001, 1], below: [0, -0.4, -1]};
    controls.minDistance = 0;
    if (meta.plane) {
      camera.position.set(middle.x, middle.y, 1);
      camera.zoom = 1;
      camera.updateProjectionMatrix();
    } else if (from === 'inside' && meta.inside) {
      const along = new THREE.Vector3(...meta.inside.along);
      camera.position.set(...meta.inside.place);
      middle.copy(camera.position).addScaledVector(along, 0.02 * this.size);
    } else {
      const low = new THREE.Vector3(...meta.tight[0]);
      const high = new THREE.Vector3(...meta.tight[1]);
      middle.copy(low).add(high).multiplyScalar(0.5);
      const back = new THREE.Vector3(...(sides[from] ?? sides.home));
      camera.position.copy(middle).addScaledVector(
        back.normalize(), this.distance_for(low, high, middle, back));
    }
    controls.target.copy(middle);
    camera.up.copy(from === 'top' ? new THREE.Vector3(0, 1, 0) : up);
    controls.update();
    this.resize();
  }

  // How far the camera has to stand back to have all of a box in sight.
  distance_for(low, high, middle, back) {
    const tall = Math.tan(Math.PI * this.camera.fov / 360);
    const wide = tall * this.canvas.clientWidth / this.canvas.clientHeight;
    const right = new THREE.Vector3().crossVectors(
      Math.abs(back.dot(this.up)) > 0.99 ? new THREE.Vector3(0, 1, 0)
                                         : this.up, back).normalize();
    const up = new THREE.Vector3().crossVectors(back, right);
    let distance = 0;
    for (let k = 0; k < 8; ++k) {
      const corner = new THREE.Vector3(k & 1 ? low.x : high.x,
                                       k & 2 ? low.y : high.y,
                                       k & 4 ? low.z : high.z).sub(middle);
      distance = Math.max(distance, corner.dot(back) + Math.max(
        Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / tall));
    }
    return 1.06 * distance;
  }

  pick(event) {
    const box = this.canvas.getBoundingClientRect(), ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(
      2 * (event.clientX - box.left) / box.width - 1,
      1 - 2 * (event.clientY - box.top) / box.height), this.camera);
    const hit = ray.intersectObjects(Object.values(this.meshes)).find(
      (one) => this.cut.distanceToPoint(one.point) >= 0);
    this.choose(hit ? hit.object.userData.blocks[hit.faceIndex] : 0);
  }

  // Mark a block here and in the table; show its row if it was clicked here.
  choose(number, is_from_table = false) {
    this.chosen = number;
    const block = this.meta.blocks[number];
    element('chosen').innerHTML = block
      ? `<b>Block ${number}</b><br>${block.lines.join('<br>')}`
      : '';
    element('chosen').hidden = !block;
    for (const row of document.querySelectorAll('tr.chosen'))
      row.classList.remove('chosen');
    const row = document.querySelector(`tr[data-block="${number}"]`);
    if (row) {
      row.classList.add('chosen');
      const details = row.closest('details');
      if (details && !is_from_table) details.open = true;
      const frame = row.closest('.tall');
      if (frame && !is_from_table)
        frame.scrollTop = row.offsetTop - frame.clientHeight / 2;
    }
    if (block && is_from_table) {
      if (!block.exposed) this.shows.hidden = true;
      const box = element('show-hidden');
      if (box) box.checked = this.shows.hidden;
      this.go_to_state_with(number);
    }
    this.update();
    if (is_from_table) this.turn_to(number);
  }

  // The last state in which a block is there, if it is not in this one.
  go_to_state_with(number) {
    const {triangle_block: block, triangle_seen: seen} = this.data;
    let states = 0;
    for (let t = 0; t < block.length; ++t)
      if (block[t] === number) states |= seen[t];
    if (states & (1 << this.state) || !states) return;
    this.state = 31 - Math.clz32(states);
    element('stage').value = this.state;
    this.name_stage();
  }

  turn_to(number) {
    const {triangles, triangle_block: block} = this.data;
    const box = new THREE.Box3(), point = new THREE.Vector3();
    for (let t = 0; t < block.length; ++t)
      if (block[t] === number)
        for (let c = 0; c < 3; ++c)
          box.expandByPoint(point.fromArray(this.positions,
                                            3 * triangles[3 * t + c]));
    if (box.isEmpty()) return;
    const middle = box.getCenter(new THREE.Vector3());
    const move = middle.clone().sub(this.controls.target);
    this.camera.position.add(move);
    this.controls.target.copy(middle);
    this.controls.update();
    this.render();
  }

  name_stage() {
    element('stage-name').textContent = this.meta.stages[this.state];
  }

  make_controls() {
    const {meta} = this, on = (name, event, action) => {
      const found = element(name);
      if (found) found.addEventListener(event, () => action(found));
    };
    const stage = element('stage');
    stage.max = meta.stages.length - 1;
    stage.value = this.state;
    on('stage', 'input', (input) => {
      this.state = +input.value;
      this.name_stage();
      this.update();
    });
    for (const [name, step] of [['earlier', -1], ['later', 1]])
      on(name, 'click', () => {
        stage.value = this.state + step;
        stage.dispatchEvent(new Event('input'));
      });
    this.name_stage();
    const factors = [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000,
                     10000, 20000, 50000, 100000];
    const factor = element('factor');
    factor.max = factors.length - 1;
    factor.value = Math.max(0, factors.indexOf(this.exaggeration));
    const tell = () => {
      element('factor-value').textContent = this.exaggeration;
    };
    on('factor', 'input', (input) => {
      this.exaggeration = factors[+input.value];
      tell();
      this.update();
    });
    tell();
    for (const name of ['rock', 'exposed', 'hidden', 'edges', 'labels']) {
      const box = element(`show-${name}`);
      box.checked = this.shows[name];
      on(`show-${name}`, 'change', () => {
        this.shows[name] = box.checked;
        this.update();
      });
    }
    if (!meta.stress) element('colouring').options[2].remove();
    on('colouring', 'change', (select) => {
      this.colouring = select.value;
      this.update();
    });
    for (const name of ['home', 'inside', 'top', 'below', 'x', 'y'])
      on(`look-${name}`, 'click', () => this.look(name));
    if (!meta.inside && element('look-inside'))
      element('look-inside').hidden = true;
    this.make_cut(on);
    this.make_legends();
    for (const row of document.querySelectorAll('tr[data-block]'))
      row.addEventListener('click', (event) => {
        if (event.target.closest('button.show'))
          element('view').scrollIntoView({block: 'center'});
        if (!event.target.closest('a'))
          this.choose(+row.dataset.block, true);
      });
  }

  make_cut(on) {
    const axes = {x: 0, y: 1, z: 2};
    const cut = () => {
      const axis = element('cut-axis').value;
      const turn = element('cut-turn').checked ? 1 : -1;
      if (!(axis in axes)) {
        this.cut.set(new THREE.Vector3(0, -1, 0), 1e9);
        element('cut-value').textContent = '';
      } else {
        const k = axes[axis], share = element('cut').value / 100;
        const low = this.low.getComponent(k), high = this.high.getComponent(k);
        const at = low + share * (high - low);
        const normal = new THREE.Vector3().setComponent(k, turn);
        this.cut.set(normal, -turn * at);
        element('cut-value').textContent =
          `${axis} = ${(at + this.meta.centre[k]).toPrecision(4)} m`;
      }
      this.render();
    };
    for (const name of ['cut', 'cut-axis', 'cut-turn'])
      if (element(name)) on(name, 'input', cut);
  }

  make_legends() {
    const {meta} = this, used = new Set(Object.values(meta.blocks).map(
      (block) => block.state));
    element('states').innerHTML = Object.entries(meta.colours)
      .filter(([key]) => used.has(key)).map(([, [colour, text]]) =>
        `<div><span class="mark" style="background:${colour}"></span>${text}</div>`)
      .join('');
    const list = element('groups');
    meta.groups.forEach((group, k) => {
      const label = document.createElement('label');
      const box = Object.assign(document.createElement('input'),
                                {type: 'checkbox'});
      box.addEventListener('change', () => {
        this.shows.groups[box.checked ? 'add' : 'delete'](k);
        this.update();
      });
      const mark = Object.assign(document.createElement('span'),
                                 {className: 'mark'});
      mark.style.background = group.colour;
      label.append(box, ' ', mark, group.name);
      list.append(label);
    });
    if (!meta.groups.length) list.closest('fieldset').hidden = true;
  }
}

if (typeof DecompressionStream === 'undefined') {
  fail('This browser is too old for the view (no DecompressionStream).');
} else {
  read().then(({meta, data}) => {
    try {
      window.keyblock_view = new View(meta, data);
    } catch (error) {
      if (!/WebGL/.test(error.message)) throw error;
      fail('This browser has no WebGL, which the view needs.');
    }
  });
}
