// What replays of simulated flights show beyond scans: the true scene, the world model, candidate
// motions and commands.
'use strict';
window.flight = async view => {
const {data, scene, lines, layers, layer, surface, state} = view, flight = data.flight;
const arrays = await view.unpack(flight);
const points = values => Float32Array.from(values, n => n * data.unit_m);
const track = points(arrays.track), moments = track.length / 3;
const speeds = points(arrays.speeds), clearances = points(arrays.clearances);
const middles = points(arrays.middles), lives = arrays.lives;
const cells = lives.length / 2, edge = flight.model_edge_m;
const ends = Math.max(0, moments - 1) * flight.control_step_s;  // after the last step

const colors = {rou: 0x9aa5b1, model: 0xe69f00, above: 0xb58a3c, free: 0x009e73, blocked: 0xcc79a7, track: 0x0072b2,
                path: 0x7a3fb0, command: 0x1d2530, scene: 0x6f8a66, ground: 0xb2bbab, mover: 0xb03a3a, roi: 0xd55e00};
const kindColors = {tree: 0x6f8a66, canopy: 0xa3b88c, wall: 0x8b8f98, building: 0x8b8f98, vehicle: 0x7488a3,
                    pole: 0x4c535c, wire: 0x4c535c};

// ---- true scene: each shape once, and the poses of its instances
const truth = new THREE.Group();
scene.add(truth);
const shapes = flight.scene.shapes.map(name => {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(
      Float32Array.from(arrays[name], n => n * flight.scene.unit_m), 3));
  geometry.computeVertexNormals();
  return geometry;
});
for (const thing of flight.scene.things) {
  const made = new THREE.InstancedMesh(shapes[thing.shape], surface(kindColors[thing.kind] || colors.scene, 0.6),
                                       thing.poses.length);
  thing.poses.forEach((pose, i) => made.setMatrixAt(i, new THREE.Matrix4().set(...pose, 0, 0, 0, 1)));
  view.placed(made, truth);
}
const movers = flight.scene.movers.map(mover => {
  const poses = arrays[mover.poses], made = view.placed(new THREE.Mesh(shapes[mover.shape], surface(colors.mover, 0.85)), truth);
  const place = (i, k) => poses[4 * i + k] * data.unit_m;
  const heading = i => poses[4 * i + 3] * flight.scene.turn_unit_rad;
  return {moveTo: when => {
    const last = poses.length / 4 - 1, rank = Math.max(0, Math.min(last, when / flight.scene.mover_step_s));
    const low = Math.floor(rank), high = Math.min(low + 1, last), share = rank - low;
    made.position.set(...[0, 1, 2].map(k => (1 - share) * place(low, k) + share * place(high, k)));
    const turn = heading(high) - heading(low);  // the shorter rotation
    made.rotation.z = heading(low) + share * Math.atan2(Math.sin(turn), Math.cos(turn));
  }};
});
// The surface is slightly below the ground, so that returns stay above it.
const {x_m, y_m, step_m, along_x, along_y} = flight.scene.ground;
const {wires, faced} = view.grid(x_m, y_m, step_m, along_x, along_y, points(arrays.ground));
view.placed(new THREE.LineSegments(wires, new THREE.LineBasicMaterial({color: 0xbcc5ce})));
view.placed(new THREE.Mesh(faced, surface(colors.ground, 1)), truth).position.z = -0.15;

const ball = (radius, color, opacity) => view.placed(new THREE.Mesh(new THREE.SphereGeometry(radius, 24, 16), surface(color, opacity)));
const free = lines(THREE.LineSegments, colors.free, 0.55), blocked = lines(THREE.LineSegments, colors.blocked, 0.4);
const flown = lines(THREE.Line, colors.track, 1), path = lines(THREE.Line, colors.path, 1);
flown.set(track);
const carrot = ball(0.16, colors.path, 1);
ball(1.5, colors.free, 0.25).position.set(...flight.goal_m);
const arrow = new THREE.ArrowHelper(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 1, colors.command, 0.35, 0.2);
scene.add(arrow);

// ---- vehicle
const dark = surface(0x2b3440, 1);
view.vehicle.add(new THREE.Mesh(new THREE.CylinderGeometry(0.11, 0.11, 0.12, 20).rotateX(Math.PI / 2), dark));
for (const angle of [Math.PI / 4, -Math.PI / 4]) {
  const arm = new THREE.Mesh(new THREE.BoxGeometry(0.62, 0.035, 0.035), dark);
  arm.rotation.z = angle;
  view.vehicle.add(arm);
}
for (const [x, y] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
  const rotor = new THREE.Mesh(new THREE.TorusGeometry(0.15, 0.02, 8, 24), surface(x > 0 ? colors.roi : colors.track, 1));
  rotor.position.set(0.22 * x, 0.22 * y, 0.03);
  view.vehicle.add(rotor);
}
const room = new THREE.Mesh(new THREE.SphereGeometry(flight.radius_m, 24, 16), surface(colors.track, 0.12));
view.vehicle.add(room);

// ---- the model's cells: boxes if they have an edge, otherwise points. Low cells, mostly ground,
// are paler; those above the altitude limit are hidden by default.
function boxes(color, opacity) {
  const size = 0.5 * edge;  // smaller than a cell, so that gaps are visible
  const made = view.placed(new THREE.InstancedMesh(new THREE.BoxBufferGeometry(size, size, size), surface(color, opacity), Math.max(1, cells)));
  const matrices = made.instanceMatrix.array;
  for (let i = 0; i < matrices.length; i += 16) matrices.set([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], i);
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
  const geometry = new THREE.BufferGeometry();
  const held = view.placed(new THREE.Points(geometry, new THREE.PointsMaterial({color: colors.model, size: 0.09})));
  model = {object: held, show: list => {
    const coordinates = new Float32Array(3 * list.length);
    list.forEach((cell, i) => coordinates.set(middles.subarray(3 * cell, 3 * cell + 3), 3 * i));
    geometry.setAttribute('position', new THREE.BufferAttribute(coordinates, 3));
    geometry.setDrawRange(0, list.length);
  }};
}

layer('scene', 'true scene', colors.scene, [truth]);
layer('model', 'world model (' + flight.model_name + ')', colors.model, [model.object]);
if (low) {
  layer('low', 'voxels below 0.6 m', colors.rou, [low.object]);
  layer('above', 'voxels above 4.5 m', colors.above, [above.object], true);
}
layer('free', 'motions, free', colors.free, [free.object]);
layer('blocked', 'motions, blocked', colors.blocked, [blocked.object]);
layer('path', 'planned path and carrot', colors.path, [path.object, carrot]);
layer('flown', 'path flown', colors.track, [flown.object]);
layer('command', 'command', colors.command, [arrow]);

// ---- one planning step
let shown = -1;
function show(index, frame) {
  shown = index;
  const seen = index >= 0, apart = {free: [], blocked: []};
  if (seen) {
    const ways = points(frame.ways);
    let at = 0;
    for (const size of frame.way_sizes) {  // negative: not free
      const into = size > 0 ? apart.free : apart.blocked, count = Math.abs(size);
      for (let i = 0; i + 1 < count; ++i) into.push(...ways.subarray(3 * (at + i), 3 * (at + i + 2)));
      at += count;
    }
  }
  free.set(new Float32Array(apart.free));
  blocked.set(new Float32Array(apart.blocked));
  path.set(seen ? points(frame.path) : new Float32Array());
  const list = [];
  for (let cell = 0; seen && cell < cells; ++cell) {
    if (lives[2 * cell] <= index && index < lives[2 * cell + 1]) list.push(cell);
  }
  model.show(list);
  state.held = String(list.length);
  carrot.visible = seen && layers.path.checked;
  arrow.visible = false;
  if (!seen) return;
  const step = data.frames[index], command = new THREE.Vector3(...step.command_m_s), speed = command.length();
  carrot.position.set(...step.carrot_m);
  arrow.visible = layers.command.checked && speed > 0.05;
  if (speed > 0.05) {
    arrow.setDirection(command.clone().normalize());
    arrow.setLength(0.5 * speed, 0.3, 0.18);
  }
  figures();
}
function positionAt(when) {
  const rank = Math.max(0, Math.min(moments - 1, when / flight.control_step_s));
  const low = Math.floor(rank), high = Math.min(low + 1, moments - 1), share = rank - low;
  return new THREE.Vector3(...[0, 1, 2].map(k => (1 - share) * track[3 * low + k] + share * track[3 * high + k]));
}
let time = 0;
function figures() {
  const step = shown >= 0 ? data.frames[shown] : null, over = time >= ends;
  const moment = Math.min(moments - 1, Math.round(time / flight.control_step_s));
  const clearance = moments > 0 ? clearances[moment] : NaN, alarms = [];
  if (clearance < flight.radius_m) alarms.push('clearance');
  if ((over && flight.outcome !== 'success') || (step && step.is_emergency)) alarms.push('state');
  view.showFigures({
    clearance: moments > 0 ? clearance.toFixed(2) + ' m' : '-',
    speed: moments > 0 ? speeds[moment].toFixed(1) + ' m/s' : '-',
    latency: step ? step.latency_ms.toFixed(1) + ' ms' : '-',
    'model size': (step ? step.model_size : 0) + (edge > 0 ? ' voxels' : ' points'),
    state: over ? flight.outcome : step && step.is_emergency ? 'emergency stop' : 'flying'
  }, alarms);
  const hit = over && flight.outcome === 'collision';
  room.material.color.setHex(hit ? colors.mover : colors.track);
  room.material.opacity = hit ? 0.4 : 0.12;
  state.clearance = clearance.toFixed(2);
}
function move(when) {
  time = when;
  const position = positionAt(time);
  view.moveCamera(position, view.vehicle.position.clone());
  arrow.position.copy(position);
  flown.object.geometry.setDrawRange(0, Math.floor(time / flight.control_step_s) + 1);
  for (const mover of movers) mover.moveTo(time);
  figures();
}
return {ends, show, move};
};
