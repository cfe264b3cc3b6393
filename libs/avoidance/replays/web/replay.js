// Plays a recorded run: scans, world model, candidate motions and commands.
'use strict';
(() => {
const data = JSON.parse(document.getElementById('data').textContent);
const byId = id => document.getElementById(id);

// ---- data: 16-bit numbers in base64, centimetres from the start
function numbers(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return new Int16Array(bytes.buffer);
}
const points = text => Float32Array.from(numbers(text), n => n * data.unit_m);
const track = points(data.track), moments = track.length / 3;
const speeds = points(data.speeds), clearances = points(data.clearances);
const goal = points(data.goal);
const middles = points(data.model.middles), lives = numbers(data.model.lives);
const cells = lives.length / 2, edge = data.model.edge_m;
const ends = Math.max(0, moments - 1) * data.control_step_s;  // after the last step

// ---- scene
const colors = {roi: 0xd55e00, rou: 0x9aa5b1, model: 0xe69f00, above: 0xb58a3c, free: 0x009e73, blocked: 0xcc79a7,
                track: 0x0072b2, path: 0x7a3fb0, command: 0x1d2530, scene: 0x6f8a66, ground: 0xb2bbab, mover: 0xb03a3a};
const kindColors = {tree: 0x6f8a66, canopy: 0xa3b88c, wall: 0x8b8f98, building: 0x8b8f98, vehicle: 0x7488a3,
                    pole: 0x4c535c, wire: 0x4c535c};
const view = byId('view');
let renderer;
try {
  renderer = new THREE.WebGLRenderer({antialias: true});
} catch (error) {
  view.innerHTML = '<p class="failed">This page needs WebGL, which this browser does not provide.</p>';
  return;
}
renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
view.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xeef1f4);
scene.add(new THREE.HemisphereLight(0xffffff, 0x9aa5b1, 0.95));
const sun = new THREE.DirectionalLight(0xffffff, 0.45);
sun.position.set(-10, -20, 30);
scene.add(sun);
const camera = new THREE.PerspectiveCamera(50, 1, 0.1, 500);
camera.up.set(0, 0, 1);
camera.position.set(-10, -5, 6);
const controls = new THREE.OrbitControls(camera, renderer.domElement);
controls.maxDistance = 150;

// ---- true scene: each shape once, and the poses of its instances
const truth = new THREE.Group();
scene.add(truth);
const shapes = data.scene.shapes.map(text => {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(
      Float32Array.from(numbers(text), n => n * data.scene.unit_m), 3));
  geometry.computeVertexNormals();
  return geometry;
});
const surface = (color, opacity) => new THREE.MeshLambertMaterial(
    {color, side: THREE.DoubleSide, transparent: opacity < 1, opacity, depthWrite: opacity === 1});
for (const thing of data.scene.things) {
  const made = new THREE.InstancedMesh(shapes[thing.shape], surface(kindColors[thing.kind] || colors.scene, 0.6),
                                       thing.poses.length);
  thing.poses.forEach((pose, i) => made.setMatrixAt(i, new THREE.Matrix4().set(...pose, 0, 0, 0, 1)));
  made.frustumCulled = false;
  truth.add(made);
}
const movers = data.scene.movers.map(mover => {
  const poses = numbers(mover.poses), made = new THREE.Mesh(shapes[mover.shape], surface(colors.mover, 0.85));
  truth.add(made);
  const place = (i, k) => poses[4 * i + k] * data.unit_m;
  const heading = i => poses[4 * i + 3] * data.scene.turn_unit_rad;
  return {moveTo: when => {
    const last = poses.length / 4 - 1, rank = Math.max(0, Math.min(last, when / data.scene.mover_step_s));
    const low = Math.floor(rank), high = Math.min(low + 1, last), share = rank - low;
    made.position.set(...[0, 1, 2].map(k => (1 - share) * place(low, k) + share * place(high, k)));
    const turn = heading(high) - heading(low);  // the shorter rotation
    made.rotation.z = heading(low) + share * Math.atan2(Math.sin(turn), Math.cos(turn));
  }};
});

/// The ground: a wire grid, and a surface slightly below so that returns stay above it.
function ground() {
  const {x_m, y_m, step_m, along_x, along_y} = data.scene.ground, heights = points(data.scene.ground.heights);
  const corners = [], edges = [], faces = [];
  for (let j = 0; j < along_y; ++j) {
    for (let i = 0; i < along_x; ++i) {
      const at = j * along_x + i, right = i + 1 < along_x, up = j + 1 < along_y;
      corners.push(x_m + i * step_m, y_m + j * step_m, heights[at]);
      if (right) edges.push(at, at + 1);
      if (up) edges.push(at, at + along_x);
      if (right && up) faces.push(at, at + 1, at + along_x, at + 1, at + along_x + 1, at + along_x);
    }
  }
  const geometryOf = index => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
    geometry.setIndex(index);
    return geometry;
  };
  scene.add(new THREE.LineSegments(geometryOf(edges), new THREE.LineBasicMaterial({color: 0xbcc5ce})));
  const faced = geometryOf(faces);
  faced.computeVertexNormals();
  const made = new THREE.Mesh(faced, surface(colors.ground, 1));
  made.position.z = -0.15;
  truth.add(made);
}
ground();

/// A point cloud of variable size.
function cloud(color, size) {
  const geometry = new THREE.BufferGeometry();
  const made = new THREE.Points(geometry, new THREE.PointsMaterial({color, size}));
  made.frustumCulled = false;
  scene.add(made);
  return {object: made, set: coordinates => {
    geometry.setAttribute('position', new THREE.BufferAttribute(coordinates, 3));
    geometry.setDrawRange(0, coordinates.length / 3);
  }};
}
function lines(kind, color, opacity) {
  const geometry = new THREE.BufferGeometry();
  const made = new kind(geometry, new THREE.LineBasicMaterial(
      {color, transparent: opacity < 1, opacity}));
  made.frustumCulled = false;
  scene.add(made);
  return {object: made, set: coordinates => {
    geometry.setAttribute('position', new THREE.BufferAttribute(coordinates, 3));
    geometry.setDrawRange(0, coordinates.length / 3);
  }};
}
function ball(radius, color, opacity) {
  const made = new THREE.Mesh(new THREE.SphereGeometry(radius, 24, 16),
      new THREE.MeshLambertMaterial({color, transparent: opacity < 1, opacity}));
  scene.add(made);
  return made;
}

const roi = cloud(colors.roi, 0.11), rou = cloud(colors.rou, 0.07);
const free = lines(THREE.LineSegments, colors.free, 0.55);
const blocked = lines(THREE.LineSegments, colors.blocked, 0.4);
const flown = lines(THREE.Line, colors.track, 1), path = lines(THREE.Line, colors.path, 1);
flown.set(track);
const carrot = ball(0.16, colors.path, 1);
const target = ball(1.5, colors.free, 0.25);
target.position.set(goal[0], goal[1], goal[2]);
const arrow = new THREE.ArrowHelper(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 1,
                                    colors.command, 0.35, 0.2);
scene.add(arrow);

function vehicle() {
  const group = new THREE.Group();
  const dark = new THREE.MeshLambertMaterial({color: 0x2b3440});
  const body = new THREE.Mesh(new THREE.CylinderGeometry(0.11, 0.11, 0.12, 20), dark);
  body.rotation.x = Math.PI / 2;
  group.add(body);
  for (const angle of [Math.PI / 4, -Math.PI / 4]) {
    const arm = new THREE.Mesh(new THREE.BoxGeometry(0.62, 0.035, 0.035), dark);
    arm.rotation.z = angle;
    group.add(arm);
  }
  for (const [x, y] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
    const rotor = new THREE.Mesh(new THREE.TorusGeometry(0.15, 0.02, 8, 24),
        new THREE.MeshLambertMaterial({color: x > 0 ? colors.roi : colors.track}));
    rotor.position.set(0.22 * x, 0.22 * y, 0.03);
    group.add(rotor);
  }
  const room = new THREE.Mesh(new THREE.SphereGeometry(data.radius_m, 24, 16),
      new THREE.MeshBasicMaterial({color: colors.track, transparent: true, opacity: 0.12,
                                   depthWrite: false}));
  group.add(room);
  scene.add(group);
  return {body: group, room};
}
const {body: drone, room} = vehicle();

// The model's cells: boxes if they have an edge, otherwise points. Low cells, mostly ground, are
// paler; those above the altitude limit are hidden by default.
function boxes(color, opacity) {
  const size = 0.5 * edge;  // smaller than a cell, so that gaps are visible
  const made = new THREE.InstancedMesh(new THREE.BoxBufferGeometry(size, size, size),
      new THREE.MeshLambertMaterial({color, transparent: opacity < 1, opacity, depthWrite: opacity === 1}),
      Math.max(1, cells));
  const matrices = made.instanceMatrix.array;
  for (let i = 0; i < matrices.length; i += 16) matrices.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], i);
  made.frustumCulled = false;
  scene.add(made);
  return {object: made, show: list => {
    list.forEach((cell, i) => {
      for (let k = 0; k < 3; ++k) matrices[16 * i + 12 + k] = middles[3 * cell + k];
    });
    made.count = list.length;
    made.instanceMatrix.needsUpdate = true;
  }};
}
let model, low, above;
if (edge > 0) {
  const inside = boxes(colors.model, 1);
  low = boxes(colors.rou, 0.35);
  above = boxes(colors.above, 0.6);
  const height = cell => middles[3 * cell + 2] - data.ground_m;
  model = {object: inside.object, show: list => {
    low.show(list.filter(cell => height(cell) < 0.6));
    inside.show(list.filter(cell => height(cell) >= 0.6 && height(cell) < 4.5));
    above.show(list.filter(cell => height(cell) >= 4.5));
  }};
} else {
  const held = cloud(colors.model, 0.09);
  model = {object: held.object, show: list => {
    const coordinates = new Float32Array(3 * list.length);
    list.forEach((cell, i) => coordinates.set(middles.subarray(3 * cell, 3 * cell + 3), 3 * i));
    held.set(coordinates);
  }};
}

// ---- one step
let shown = -2, held = 0;
const decoded = new Map();
function stepData(index) {
  if (!decoded.has(index)) {
    const step = data.steps[index], ways = points(step.ways), apart = {free: [], blocked: []};
    let at = 0;
    for (const size of step.way_sizes) {
      const into = size > 0 ? apart.free : apart.blocked, count = Math.abs(size);
      for (let i = 0; i + 1 < count; ++i) into.push(...ways.subarray(3 * (at + i), 3 * (at + i + 2)));
      at += count;
    }
    decoded.set(index, {roi: points(step.roi), rou: points(step.rou), path: points(step.path),
                        carrot: points(step.carrot), free: new Float32Array(apart.free),
                        blocked: new Float32Array(apart.blocked)});
  }
  return decoded.get(index);
}
function stepAt(time) {
  let low = -1, high = data.steps.length - 1;  // the last step not later than `time`
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (data.steps[middle].time_s <= time) low = middle; else high = middle - 1;
  }
  return low;
}
const nothing = new Float32Array(0);
function showStep(index) {
  if (index === shown) return;
  shown = index;
  const seen = index >= 0;
  const now = seen ? stepData(index) : {roi: nothing, rou: nothing, path: nothing, free: nothing, blocked: nothing};
  for (const [what, place] of [['roi', roi], ['rou', rou], ['path', path], ['free', free], ['blocked', blocked]]) {
    place.set(now[what]);
  }
  const list = [];
  for (let cell = 0; seen && cell < cells; ++cell) {
    if (lives[2 * cell] <= index && index < lives[2 * cell + 1]) list.push(cell);
  }
  held = list.length;
  model.show(list);
  carrot.visible = seen && layers.path.checked;
  arrow.visible = seen && layers.command.checked;
  if (seen) {
    carrot.position.set(...now.carrot);
    const command = new THREE.Vector3(...data.steps[index].command_m_s), speed = command.length();
    arrow.visible = arrow.visible && speed > 0.05;
    if (speed > 0.05) {
      arrow.setDirection(command.clone().normalize());
      arrow.setLength(0.5 * speed, 0.3, 0.18);
    }
  }
}

// ---- panels
const wide = window.matchMedia('(min-width: 561px)');
byId('layers').open = wide.matches;
const layers = {};
function layer(name, label, color, objects, hidden) {
  const line = document.createElement('label'), box = document.createElement('input');
  box.type = 'checkbox';
  box.checked = !hidden;
  if (hidden) objects.forEach(one => { one.visible = false; });
  box.dataset.layer = name;
  const swatch = document.createElement('i');
  swatch.style.background = '#' + color.toString(16).padStart(6, '0');
  line.append(box, swatch, label);
  byId('layers').append(line);
  box.addEventListener('change', () => { objects.forEach(one => { one.visible = box.checked; }); draw(); });
  layers[name] = box;
}
layer('scene', 'true scene', colors.scene, [truth]);
layer('roi', 'regions of interest', colors.roi, [roi.object]);
layer('rou', 'other returns', colors.rou, [rou.object]);
layer('model', 'world model (' + data.model_name + ')', colors.model, [model.object]);
if (low) {
  layer('low', 'voxels below 0.6 m', colors.rou, [low.object]);
  layer('above', 'voxels above 4.5 m', colors.above, [above.object], true);
}
layer('free', 'motions, free', colors.free, [free.object]);
layer('blocked', 'motions, blocked', colors.blocked, [blocked.object]);
layer('path', 'planned path and carrot', colors.path, [path.object, carrot]);
layer('flown', 'path flown', colors.track, [flown.object]);
layer('command', 'command', colors.command, [arrow]);

byId('ending').textContent = data.ending.charAt(0).toUpperCase() + data.ending.slice(1);
byId('ending').className = data.outcome === 'success' ? '' : 'alarm';
byId('note').textContent = data.is_same ? '' :
    'Flown again, the result differs from the table: another version or machine?';
const figures = {};
for (const name of ['clearance', 'speed', 'latency', 'model size', 'state']) {
  const term = document.createElement('dt'), value = document.createElement('dd');
  term.textContent = name;
  byId('figures').append(term, value);
  figures[name] = value;
}
for (const event of data.events) {
  const item = document.createElement('li'), button = document.createElement('button');
  button.type = 'button';
  button.textContent = event.time_s.toFixed(2) + ' s: ' + event.what;
  button.addEventListener('click', () => { pause(); seek(event.time_s); });
  item.append(button);
  byId('events').append(item);
}

function showFigures() {
  const step = shown >= 0 ? data.steps[shown] : null;
  const moment = Math.min(moments - 1, Math.round(time / data.control_step_s));
  const clearance = moments > 0 ? clearances[moment] : NaN;
  figures.clearance.textContent = moments > 0 ? clearance.toFixed(2) + ' m' : '-';
  figures.clearance.className = clearance < data.radius_m ? 'alarm' : '';
  figures.speed.textContent = moments > 0 ? speeds[moment].toFixed(1) + ' m/s' : '-';
  figures.latency.textContent = step ? step.latency_ms.toFixed(1) + ' ms' : '-';
  figures['model size'].textContent = (step ? step.model_size : 0) + (edge > 0 ? ' voxels' : ' points');
  const over = time >= ends;
  figures.state.textContent = over ? data.outcome : step && step.emergency ? 'emergency stop' : 'flying';
  figures.state.className = (over && data.outcome !== 'success') || (step && step.emergency) ? 'alarm' : '';
  const hit = over && data.outcome === 'collision';
  room.material.color.setHex(hit ? colors.mover : colors.track);
  room.material.opacity = hit ? 0.4 : 0.12;
  document.body.dataset.clearance = clearance.toFixed(2);
}

// ---- time
let time = 0, playing = false, before = 0;
const slider = byId('time'), play = byId('play'), follow = byId('follow');
slider.max = String(ends);

function positionAt(when) {
  const rank = Math.max(0, Math.min(moments - 1, when / data.control_step_s));
  const low = Math.floor(rank), high = Math.min(low + 1, moments - 1), share = rank - low;
  return new THREE.Vector3(...[0, 1, 2].map(k => (1 - share) * track[3 * low + k] + share * track[3 * high + k]));
}
function seek(when) {
  time = Math.max(0, Math.min(ends, when));
  const position = positionAt(time);
  const moved = position.clone().sub(drone.position);
  drone.position.copy(position);
  arrow.position.copy(position);
  if (follow.checked) {
    camera.position.add(moved);
    controls.target.copy(position);
  }
  flown.object.geometry.setDrawRange(0, Math.floor(time / data.control_step_s) + 1);
  for (const mover of movers) mover.moveTo(time);
  showStep(stepAt(time));
  showFigures();
  slider.value = String(time);
  byId('clock').textContent = time.toFixed(2) + ' s';
  document.body.dataset.time = time.toFixed(3);
  document.body.dataset.step = String(shown);
  document.body.dataset.held = String(held);
  draw();
}
function pause() {
  playing = false;
  play.innerHTML = '&#9654;';
  play.setAttribute('aria-label', 'Play');
}
function start() {
  if (time >= ends) seek(0);
  playing = true;
  before = performance.now();
  play.innerHTML = '&#10074;&#10074;';
  play.setAttribute('aria-label', 'Pause');
  requestAnimationFrame(tick);
}
function tick(now) {
  if (!playing) return;
  const passed = Math.min(0.25, Math.max(0, (now - before) / 1000));
  before = now;
  seek(time + passed * Number(byId('rate').value));
  if (time >= ends) pause(); else requestAnimationFrame(tick);
}
/// The flight continues after its last command until its end. A command still being computed at the
/// end was never issued.
const given = data.steps.filter(step => step.time_s < ends).length;
function toStep(index) {
  pause();
  if (index < 0 || given === 0) return seek(0);
  seek(index < given ? data.steps[index].time_s + 1e-6 : ends);
}
const stepBefore = () => time >= ends ? given - 1 : shown - 1;
play.addEventListener('click', () => playing ? pause() : start());
slider.addEventListener('input', () => { pause(); seek(Number(slider.value)); });
follow.addEventListener('change', () => seek(time));
const keys = {
  ' ': () => playing ? pause() : start(),
  ArrowRight: () => toStep(shown + 1), ArrowLeft: () => toStep(stepBefore()),
  Home: () => { pause(); seek(0); }, End: () => { pause(); seek(ends); },
  f: () => { follow.checked = !follow.checked; seek(time); }
};
document.addEventListener('keydown', event => {
  if (event.target.tagName === 'SELECT' || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === ' ' && event.target.tagName === 'INPUT' && event.target.type === 'checkbox') return;
  const act = keys[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});

function draw() { renderer.render(scene, camera); }
controls.addEventListener('change', draw);
function resize() {
  const width = view.clientWidth, height = view.clientHeight;
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  renderer.setSize(width, height);
  draw();
}
window.addEventListener('resize', resize);
resize();
controls.target.set(0, 0, 0);
// An address with #t=5 starts at 5 s; otherwise, the page shows the first plan.
const asked = window.location.hash.match(/^#t=([0-9.]+)$/);
seek(asked ? Number(asked[1]) : data.steps.length > 0 ? data.steps[0].time_s : 0);
controls.update();
})();
