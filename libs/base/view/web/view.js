// Shows recorded scans, live scans and simulated flights. docs/view.md describes the data.
'use strict';
(async () => {
const byId = id => document.getElementById(id), state = document.body.dataset;
const data = JSON.parse(byId('data').textContent), frames = data.frames;
const made = (tag, parent, text) => {
  const element = document.createElement(tag);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
  return element;
};
const fail = text => { made('p', byId('view'), text).className = 'failed'; };
if (!window.DecompressionStream) return fail('This page needs a browser of 2023 or later.');

// ---- data: byte planes of integers, deflated, in base64
const types = {u8: Uint8Array, i8: Int8Array, u16: Uint16Array, i16: Int16Array, u32: Uint32Array, i32: Int32Array};
async function unpack(packed) {
  const text = atob(packed.data), deflated = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) deflated[i] = text.charCodeAt(i);
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer()), arrays = {};
  let at = 0;
  for (const [name, type, count, isDifferences] of packed.arrays) {
    const values = new types[type](count), raw = new Uint8Array(values.buffer), size = values.BYTES_PER_ELEMENT;
    for (let plane = 0; plane < size; ++plane) {
      for (let i = 0; i < count; ++i) raw[i * size + plane] = bytes[at++];
    }
    for (let i = 1; isDifferences && i < count; ++i) values[i] += values[i - 1];
    arrays[name] = values;
  }
  return arrays;
}
const decoded = new Map();  // the last frames, as promises
function arraysOf(index) {
  if (!decoded.has(index)) {
    decoded.set(index, unpack(frames[index]));
    if (decoded.size > 30) decoded.delete(decoded.keys().next().value);
  }
  return decoded.get(index);
}

// ---- scene
const colors = {roi: 0xd55e00, rou: 0x9aa5b1, other: 0xcc79a7, ground: 0x7d9a6f, track: 0x0072b2, box: 0x1d2530,
                free: 0x009e73, unknown: 0x9aa5b1};
const palette = [0xe69f00, 0x0072b2, 0x009e73, 0xcc79a7, 0xd55e00, 0x56b4e9, 0x8c510a, 0x5e3c99, 0x1b7837, 0xc51b7d];
const rgb = color => [(color >> 16 & 255) / 255, (color >> 8 & 255) / 255, (color & 255) / 255];
const rampStops = [0x30123b, 0x4686fb, 0x1ae4b6, 0xa4fc3c, 0xfb8022, 0x7a0403].map(rgb);  // after turbo (Mikhailov 2019)
function ramp(share) {
  const rank = Math.max(0, Math.min(1, share || 0)) * (rampStops.length - 1), low = Math.min(rampStops.length - 2, Math.floor(rank));
  return rampStops[low].map((c, k) => c + (rank - low) * (rampStops[low + 1][k] - c));
}
const view = byId('view');
let renderer;
try {
  renderer = new THREE.WebGLRenderer({antialias: true});
} catch (error) {
  return fail('This page needs WebGL, which this browser does not provide.');
}
renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
view.prepend(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xeef1f4);
scene.add(new THREE.HemisphereLight(0xffffff, 0x9aa5b1, 0.95));
const sun = new THREE.DirectionalLight(0xffffff, 0.45);
sun.position.set(-10, -20, 30);
scene.add(sun);
const camera = new THREE.PerspectiveCamera(50, 1, 0.1, 1000);
camera.up.set(0, 0, 1);
const controls = new THREE.OrbitControls(camera, renderer.domElement);
controls.maxDistance = 300;

const placed = (object, parent = scene) => {
  object.frustumCulled = false;
  parent.add(object);
  return object;
};
const setter = geometry => coordinates => {
  geometry.setAttribute('position', new THREE.BufferAttribute(coordinates, 3));
  geometry.setDrawRange(0, coordinates.length / 3);
};
function cloud(size, parent) {
  const geometry = new THREE.BufferGeometry();
  const material = new THREE.PointsMaterial({size, vertexColors: THREE.VertexColors});
  const set = setter(geometry);
  return {object: placed(new THREE.Points(geometry, material), parent), indices: [], set: (coordinates, shades) => {
    set(coordinates);
    geometry.setAttribute('color', new THREE.BufferAttribute(shades, 3));
    geometry.boundingSphere = null;
  }};
}
function lines(kind, color, opacity, parent) {
  const geometry = new THREE.BufferGeometry();
  const material = new THREE.LineBasicMaterial({color, transparent: opacity < 1, opacity});
  return {object: placed(new kind(geometry, material), parent), set: setter(geometry)};
}
const surface = (color, opacity) => new THREE.MeshLambertMaterial(
    {color, side: THREE.DoubleSide, transparent: opacity < 1, opacity, depthWrite: opacity === 1});
/// A grid of heights, row by row, as edges and faces.
function grid(minX, minY, step, alongX, alongY, heights) {
  const corners = [], edges = [], faces = [];
  for (let j = 0; j < alongY; ++j) {
    for (let i = 0; i < alongX; ++i) {
      const at = j * alongX + i, right = i + 1 < alongX, up = j + 1 < alongY;
      corners.push(minX + i * step, minY + j * step, heights[at]);
      if (right) edges.push(at, at + 1);
      if (up) edges.push(at, at + alongX);
      if (right && up) faces.push(at, at + 1, at + alongX, at + 1, at + alongX + 1, at + alongX);
    }
  }
  const [wires, faced] = [edges, faces].map(index => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
    geometry.setIndex(index);
    return geometry;
  });
  faced.computeVertexNormals();
  return {wires, faced};
}

// ---- one frame: returns, obstacles, ground and directions in the sensor frame
const sensor = new THREE.Group();
sensor.matrixAutoUpdate = false;
scene.add(sensor);
const roi = cloud(0.11, sensor), rou = cloud(0.07, sensor);
const boxes = lines(THREE.LineSegments, colors.box, 0.55, sensor);
const groundFrame = new THREE.Group();
groundFrame.matrixAutoUpdate = false;
sensor.add(groundFrame);
const groundWires = placed(new THREE.LineSegments(new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({color: colors.ground, transparent: true, opacity: 0.5})), groundFrame);
const groundFaces = placed(new THREE.Mesh(new THREE.BufferGeometry(), surface(colors.ground, 0.18)), groundFrame);
const directions = new THREE.Group();
scene.add(directions);  // level, around the vehicle
const marker = placed(new THREE.Mesh(new THREE.SphereGeometry(0.18, 16, 12), new THREE.MeshBasicMaterial({color: 0xff00aa})), sensor);
marker.visible = false;
const vehicle = new THREE.Group();
scene.add(vehicle);

const matrixOf = rows => new THREE.Matrix4().set(...(rows || [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]), 0, 0, 0, 1);

const rangeUnit = 0.04;
/// Coordinates, heights above the ground, and the colour of each obstacle.
function complete(frame, arrays) {
  if (arrays.obstacle) {  // stored for RoI returns only
    const stored = arrays.obstacle;
    let at = 0;
    arrays.obstacle = Uint16Array.from(arrays.label, label => label === 2 ? stored[at++] : 0);
  }
  let explicit = 0;  // returns with a pixel have an offset from its column instead, in 1/8 columns
  const azimuthOf = i => {
    if (!arrays.pixel || arrays.pixel[i] < 0) return arrays.azimuth[explicit++] * Math.PI / 8192;
    const [rows, columns] = frame.image, column = Math.floor(arrays.pixel[i] / rows);
    return Math.PI * (1 - 2 * (column + 0.5 - (arrays.offset[i - explicit] - 128) / 8) / columns);
  };
  const count = arrays.label.length, xyz = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    if (arrays.xyz) {
      for (let k = 0; k < 3; ++k) xyz[3 * i + k] = arrays.xyz[3 * i + k] * data.unit_m;
    } else {
      const range = arrays.range[i] * rangeUnit, elevation = arrays.elevation[i] * 0.0005, azimuth = azimuthOf(i);
      const flat = range * Math.cos(elevation);
      xyz.set([flat * Math.cos(azimuth), flat * Math.sin(azimuth), range * Math.sin(elevation)], 3 * i);
    }
  }
  arrays.positions = xyz;
  const {ground} = frame;
  if (ground) {
    const at = matrixOf(ground.from_scan), point = new THREE.Vector3(), side = ground.side;
    const heights = Float32Array.from(arrays.ground, n => n * 0.01);
    arrays.groundHeights = heights;
    arrays.height = Float32Array.from({length: count}, (_, i) => {
      point.fromArray(xyz, 3 * i).applyMatrix4(at);
      const [x, y] = [point.x, point.y].map(c => Math.max(0, Math.min(side - 1.001, (c - ground.min_m) / ground.step_m)));
      const i0 = Math.floor(x), j0 = Math.floor(y), u = x - i0, v = y - j0, h = (i, j) => heights[j * side + i];
      return point.z - (1 - v) * ((1 - u) * h(i0, j0) + u * h(i0 + 1, j0)) - v * ((1 - u) * h(i0, j0 + 1) + u * h(i0 + 1, j0 + 1));
    });
  } else if (data.ground_m !== undefined) {
    arrays.height = Float32Array.from({length: count}, (_, i) => xyz[3 * i + 2] - data.ground_m);
  }
}

/// Obstacles keep the colour of the previous frame's obstacle at their place.
let known = [];
function colourObstacles(frame) {
  const now = [], taken = new Set(), at = matrixOf(frame.pose);
  for (const [number, , , ...corners] of frame.boxes || []) {
    const centre = new THREE.Vector3(...[0, 1, 2].map(k => (corners[k] + corners[3 + k]) / 2)).applyMatrix4(at);
    const before = known.map(one => ({one, apart: one.centre.distanceTo(centre)}))
        .filter(({one, apart}) => apart < 1.5 && !taken.has(one)).sort((a, b) => a.apart - b.apart)[0];
    if (before) taken.add(before.one);
    now.push({number, centre, color: before ? before.one.color : null});
  }
  for (const one of now) {  // otherwise, a colour that is rare nearby
    if (one.color !== null) continue;
    const uses = palette.map(color => now.filter(other => other.color === color)
        .reduce((sum, other) => sum + 1 / (0.1 + other.centre.distanceTo(one.centre)), 0));
    one.color = palette[uses.indexOf(Math.min(...uses))];
  }
  known = now;
  return new Map(now.map(one => [one.number, one.color]));
}

const grey = rgb(colors.rou), orange = rgb(colors.roi), pink = rgb(colors.other);
const plain = (arrays, i) => arrays.label[i] === 2 ? orange : arrays.label[i] === 1 ? grey : pink;
const modes = {
  obstacle: {needs: 'obstacle', of: (a, i, frame) => {
    const number = a.label[i] === 2 ? a.obstacle[i] : 0;
    if (number === 0) return plain(a, i);
    const color = frame.colors.get(number);
    return rgb(color === undefined ? palette[number % palette.length] : color);
  }},
  'RoI / ROU': {needs: 'label', of: plain},
  height: {needs: 'height', ends: ['0 m', '5 m'], of: (a, i) => ramp(a.height[i] / 5)},
  intensity: {needs: 'intensity', ends: ['0', '1'], of: (a, i) => ramp(Math.sqrt(a.intensity[i] / 15))},
  range: {needs: 'range', ends: ['0 m', (data.zone_m || 20) + ' m'], of: (a, i) => ramp(a.range[i] * rangeUnit / (data.zone_m || 20))},
  ring: {needs: 'pixel', ends: ['lowest', 'highest'], of: (a, i, frame) => a.pixel[i] < 0 ? pink : ramp(a.pixel[i] % frame.image[0] / (frame.image[0] - 1))}
};
let mode = 'obstacle', current = null;  // the frame shown and its arrays

function paint() {
  if (!current) return;
  const {frame, arrays} = current, of = arrays[modes[mode].needs] ? modes[mode].of : plain;
  for (const [shown, wanted] of [[roi, label => label !== 1], [rou, label => label === 1]]) {
    shown.indices = [];
    arrays.label.forEach((label, i) => { if (wanted(label)) shown.indices.push(i); });
    const coordinates = new Float32Array(3 * shown.indices.length), shades = new Float32Array(coordinates.length);
    shown.indices.forEach((i, rank) => {
      for (let k = 0; k < 3; ++k) coordinates[3 * rank + k] = arrays.positions[3 * i + k];
      shades.set(of(arrays, i, frame), 3 * rank);
    });
    shown.set(coordinates, shades);
  }
  const {ends} = modes[mode];
  byId('ramp').hidden = !ends;
  if (ends) {
    const [low, bar, high] = byId('ramp').children;
    [low.textContent, high.textContent] = ends;
    bar.style.background = `linear-gradient(90deg, ${rampStops.map(c => `rgb(${c.map(x => 255 * x)})`)})`;
  }
  state.mode = mode;
}

let labels = [];  // of the nearest obstacles: text and place in the world
function showObstacles(frame) {
  const edges = [];
  labels = [];
  (frame.boxes || []).forEach(([number, , nearest, ...c], rank) => {
    const corner = bits => [c[bits & 1 ? 3 : 0], c[bits & 2 ? 4 : 1], c[bits & 4 ? 5 : 2]];
    for (let a = 0; a < 8; ++a) for (const bit of [1, 2, 4]) if (!(a & bit)) edges.push(...corner(a), ...corner(a | bit));
    const top = new THREE.Vector3((c[0] + c[3]) / 2, (c[1] + c[4]) / 2, c[5]);
    if (rank < 15) labels.push({text: nearest.toFixed(1) + ' m', at: top.applyMatrix4(sensor.matrix)});
  });
  boxes.set(new Float32Array(edges));
}
function placeLabels() {
  const spans = byId('labels').children, free = [];  // the nearest five that do not overlap
  for (const {text, at} of layers.boxes && layers.boxes.checked ? labels : []) {
    const seen = at.clone().project(camera), x = (seen.x + 1) * view.clientWidth / 2, y = (1 - seen.y) * view.clientHeight / 2;
    if (seen.z > 1 || free.some(other => Math.abs(other.x - x) < 52 && Math.abs(other.y - y) < 22)) continue;
    if (free.push({text, x, y}) === 5) break;
  }
  while (spans.length > free.length) spans[0].remove();
  free.forEach(({text, x, y}, i) => {
    const span = spans[i] || made('span', byId('labels'));
    span.textContent = text;
    span.style.left = x + 'px';
    span.style.top = y + 'px';
  });
}
function showGround(frame, arrays) {
  groundFrame.visible = Boolean(frame.ground);
  if (!frame.ground) return;
  const {from_scan, min_m, step_m, side} = frame.ground;
  groundFrame.matrix.getInverse(matrixOf(from_scan));
  groundFrame.matrixWorldNeedsUpdate = true;
  const {wires, faced} = grid(min_m, min_m, step_m, side, side, arrays.groundHeights);
  groundWires.geometry.dispose();
  groundFaces.geometry.dispose();
  [groundWires.geometry, groundFaces.geometry] = [wires, faced];
}
/// The directions sent to the autopilot: wedges up to the obstacle, or up to the zone if free.
function showDirections({directions: d}) {
  directions.children.slice().forEach(child => { child.geometry.dispose(); directions.remove(child); });
  (d ? d.distance_m : []).forEach((distance, i, all) => {
    const width = 2 * Math.PI / all.length, begin = -d.begin_deg * Math.PI / 180 - (i + 1) * width;  // clockwise
    const color = {occupied: colors.roi, free: colors.free}[d.state[i]] || colors.unknown;
    const outer = d.state[i] === 'occupied' ? distance : data.zone_m;
    const wedge = new THREE.Mesh(new THREE.RingGeometry(outer * 0.94, outer, 4, 1, begin, width * 0.92),
        new THREE.MeshBasicMaterial({color, side: THREE.DoubleSide, transparent: true, opacity: 0.85 / (1 + 2 * d.age_s[i])}));
    directions.add(wedge);
  });
}

// ---- images of the stages, linked to the scene
const strips = {};
const stageNames = [['depth', 'depth'], ['maxima', 'maxima'], ['angle', 'range angle'], ['smoothed', 'smoothed'], ['labels', 'labels']];
for (const [name, label] of stageNames) {
  const row = made('div', byId('stages'));
  made('span', row, label);
  strips[name] = made('canvas', row);
  strips[name].dataset.stage = name;
}
let marked = -1;  // pixel: column * rows + row
function paintStages() {
  if (!current || !current.arrays.pixel || !byId('stages').open) return;
  const {frame, arrays} = current, [rows, columns] = frame.image, zone = data.zone_m;
  const pictures = {};
  for (const [name] of stageNames) {
    Object.assign(strips[name], {width: columns, height: rows});
    pictures[name] = strips[name].getContext('2d').createImageData(columns, rows);
  }
  const put = (name, row, column, color) => {
    if (row >= rows) return;
    const at = 4 * ((rows - 1 - row) * columns + column);
    pictures[name].data.set([...color.map(c => 255 * c), 255], at);
  };
  for (let i = arrays.pixel.length; i-- > 0;) {  // a pixel's nearest return is its first, so it is last here
    const pixel = arrays.pixel[i], column = Math.floor(pixel / rows), row = pixel % rows;
    if (pixel < 0) continue;
    const near = 1 - Math.min(1, arrays.range[i] * rangeUnit / (1.5 * zone));
    put('depth', row, column, ramp(near));
    put('maxima', row, column, [0.75 + 0.2 * near, 0.78 + 0.2 * near, 0.82 + 0.16 * near]);
    put('labels', row, column, modes.obstacle.of(arrays, i, frame));
  }
  for (const pixel of arrays.maxima || []) put('maxima', pixel % rows, Math.floor(pixel / rows), rgb(0xc51b7d));
  const step = frame.angle_step;
  for (const name of ['angle', 'smoothed']) {
    const values = arrays[name], across = values ? values.length / (rows - 1) : 0;
    for (let row = 0; row + 1 < rows; ++row) {
      for (let column = 0; column < columns && values; ++column) {
        const value = values[row * across + Math.min(across - 1, Math.floor(column / step))];
        if (value > 0) put(name, row, column, ramp((value - 1) / 63));
      }
    }
  }
  for (const [name] of stageNames) {
    const pen = strips[name].getContext('2d');
    pen.putImageData(pictures[name], 0, 0);
    if (marked < 0) continue;
    pen.fillStyle = '#ff00aa';
    const x = Math.floor(marked / rows), y = rows - 1 - marked % rows, wide = Math.max(1, Math.round(columns / 500));
    pen.fillRect(x - (wide >> 1), 0, wide, rows);
    pen.fillRect(x - 8 * wide, y, 16 * wide, 1);
  }
}
function mark(pixel) {
  marked = pixel;
  const at = pixel < 0 || !current ? -1 : current.arrays.pixel.indexOf(pixel);
  marker.visible = at >= 0;
  if (at >= 0) marker.position.fromArray(current.arrays.positions, 3 * at);
  state.marked = String(pixel);
  paintStages();
  draw();
}
for (const canvas of Object.values(strips)) {
  canvas.addEventListener('pointermove', event => {
    const place = canvas.getBoundingClientRect();
    const share = [(event.clientX - place.left) / place.width, (event.clientY - place.top) / place.height];
    mark(Math.floor(share[0] * canvas.width) * canvas.height + canvas.height - 1 - Math.floor(share[1] * canvas.height));
  });
  canvas.addEventListener('pointerleave', () => mark(-1));
}
const picker = new THREE.Raycaster();
picker.params.Points.threshold = 0.12;
renderer.domElement.addEventListener('pointermove', event => {
  if (event.buttons || !current || !current.arrays.pixel || !byId('stages').open) return;
  const place = renderer.domElement.getBoundingClientRect();
  picker.setFromCamera({x: 2 * (event.clientX - place.left) / place.width - 1, y: 1 - 2 * (event.clientY - place.top) / place.height}, camera);
  const [hit] = picker.intersectObjects([roi.object, rou.object].filter(object => object.visible));
  mark(hit ? current.arrays.pixel[(hit.object === roi.object ? roi : rou).indices[hit.index]] : -1);
});
byId('stages').addEventListener('toggle', () => { resize(); paintStages(); });

// ---- panels
const wide = window.matchMedia('(min-width: 561px)');
byId('layers').open = wide.matches;
const layers = {};
function layer(name, label, color, objects, isHidden) {
  const line = made('label', byId('layers')), box = made('input', line), swatch = made('i', line);
  line.append(label);
  box.type = 'checkbox';
  box.checked = !isHidden;
  box.dataset.layer = name;
  swatch.style.background = '#' + color.toString(16).padStart(6, '0');
  objects.forEach(one => { one.visible = !isHidden; });
  box.addEventListener('change', () => { objects.forEach(one => { one.visible = box.checked; }); draw(); });
  layers[name] = box;
}
const figures = new Map();
function showFigures(values, alarms = []) {
  for (const [name, text] of Object.entries(values || {})) {
    if (!figures.has(name)) {
      made('dt', byId('figures'), name);
      figures.set(name, made('dd', byId('figures')));
    }
    figures.get(name).textContent = text;
    figures.get(name).className = alarms.includes(name) ? 'alarm' : '';
  }
}
for (const note of data.notes || []) made('p', byId('notes'), note.text || note).className = note.is_alarm ? 'alarm' : '';
for (const event of data.events || []) {
  const button = made('button', made('li', byId('events')), event.time_s.toFixed(2) + ' s: ' + event.what);
  button.type = 'button';
  button.addEventListener('click', () => { pause(); seek(event.time_s); });
}
const modeBox = byId('mode');
/// Offers the modes of all frames so far.
const offered = new Set();
function offerModes(arrays) {
  const before = offered.size;
  for (const [name, {needs}] of Object.entries(modes)) if (arrays[needs]) offered.add(name);
  if (offered.size === before) return;
  const chosen = offered.has(mode) ? mode : [...offered][0];
  modeBox.replaceChildren();
  for (const name of Object.keys(modes)) if (offered.has(name)) made('option', modeBox, name);
  mode = modeBox.value = chosen;
  byId('colouring').hidden = modeBox.options.length < 2;
}
function setMode(name) {
  mode = modeBox.value = name;
  paint();
  draw();
}
modeBox.addEventListener('change', () => { setMode(modeBox.value); modeBox.blur(); });

// ---- time
const slider = byId('time'), play = byId('play'), follow = byId('follow'), times = data.frame_times_s || [], charts = data.charts || [];
let time = 0, playing = false, before = 0, wanted = -1;
state.frame = '-1';
const path = frames.map(frame => frame.pose && frame.is_placed ? [3, 7, 11].map(k => frame.pose[k]) : null).filter(Boolean);
const flown = path.length > 1 ? lines(THREE.Line, colors.track, 1) : null;
if (flown) flown.set(Float32Array.from(path.flat()));

function apply(frame, arrays) {
  if (!arrays.positions) complete(frame, arrays);
  frame.colors = frame.colors || colourObstacles(frame);
  current = {frame, arrays};
  const from = new THREE.Vector3().setFromMatrixPosition(sensor.matrix);
  sensor.matrix.copy(matrixOf(frame.pose));
  sensor.matrixWorldNeedsUpdate = true;
  if (!hooks) moveCamera(new THREE.Vector3().setFromMatrixPosition(sensor.matrix), from);
  offerModes(arrays);
  paint();
  showObstacles(frame);
  showGround(frame, arrays);
  showDirections(frame);
  showFigures(frame.values);
  byId('stages').hidden = !arrays.pixel;
  paintStages();
}
function moveCamera(to, from) {
  vehicle.position.copy(to);
  if (!follow.checked) return;
  camera.position.add(to.clone().sub(from));
  controls.target.copy(to);
}
function frameAt(when) {
  let low = -1, high = times.length - 1;  // the last frame not later than `when`
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if (times[middle] <= when) low = middle; else high = middle - 1;
  }
  return low;
}
async function showFrame(index) {
  wanted = index;
  state.wanted = String(index);
  const arrays = index >= 0 ? await arraysOf(index) : null;
  if (wanted !== index || state.frame === String(index)) return;
  state.frame = String(index);
  if (hooks) hooks.show(index, arrays);
  if (arrays) apply(frames[index], arrays);
  draw();
  if (index + 1 < frames.length) arraysOf(index + 1);
}
const nothing = () => { roi.set(new Float32Array(), new Float32Array()); rou.set(new Float32Array(), new Float32Array()); };
let hooks = null, ends = Math.max(0, ...times.slice(-1), ...charts.map(({times_s}) => times_s[times_s.length - 1] || 0));
function seek(when) {
  time = Math.max(0, Math.min(ends, when));
  const index = frameAt(time);
  if (index < 0) nothing();
  if (hooks) hooks.move(time);
  slider.value = String(time);
  byId('clock').textContent = time.toFixed(2) + ' s';
  state.time = time.toFixed(3);
  showFrame(index);
  drawChart();
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
/// A flight continues after its last command until its end.
const given = () => times.filter(when => when < ends).length;
function toFrame(index) {
  pause();
  if (index < 0 || given() === 0) return seek(0);
  seek(index < given() ? times[index] + 1e-6 : ends);
}
const frameBefore = () => time >= ends ? given() - 1 : wanted - 1;
function topView() {
  camera.position.copy(controls.target).add(new THREE.Vector3(-0.01, 0, 2 * (data.zone_m || 20)));
  controls.update();
  draw();
}
play.addEventListener('click', () => playing ? pause() : start());
slider.addEventListener('input', () => { pause(); seek(Number(slider.value)); });
follow.addEventListener('change', () => { if (follow.checked) { controls.target.copy(vehicle.position); controls.update(); } draw(); });
const keys = {
  ' ': () => playing ? pause() : start(),
  ArrowRight: () => toFrame(wanted + 1), ArrowLeft: () => toFrame(frameBefore()),
  Home: () => { pause(); seek(0); }, End: () => { pause(); seek(ends); },
  f: () => follow.click(), t: topView
};
document.addEventListener('keydown', event => {
  if (event.target.tagName === 'SELECT' || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === ' ' && event.target.tagName === 'INPUT' && event.target.type === 'checkbox') return;
  const option = modeBox.options[Number(event.key) - 1];
  const act = option && !byId('colouring').hidden ? () => setMode(option.value) : keys[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});

// ---- statistics over time; a click jumps there
const chart = byId('chart');
chart.hidden = !charts.some(({values}) => values.length > 1);
const chartColors = ['#d55e00', '#0072b2', '#009e73'];
function drawChart() {
  if (chart.hidden) return;
  const scale = window.devicePixelRatio || 1, pen = chart.getContext('2d');
  const width = chart.width = chart.clientWidth * scale, height = chart.height = chart.clientHeight * scale;
  const across = when => (0.01 + 0.98 * when / (ends || 1)) * width;
  pen.font = `${11 * scale}px system-ui, sans-serif`;
  charts.forEach(({label, times_s, values, max}, row) => {
    const top = row * height / charts.length, tall = height / charts.length - 3 * scale;
    const highest = max || Math.max(1e-9, ...values.filter(Number.isFinite));
    pen.strokeStyle = pen.fillStyle = chartColors[row % chartColors.length];
    pen.beginPath();
    let isDown = false;
    values.forEach((value, i) => {
      if (value === null) { isDown = false; return; }
      const y = top + tall * (1 - Math.min(1, value / highest)) + 1.5 * scale;
      if (isDown) pen.lineTo(across(times_s[i]), y); else pen.moveTo(across(times_s[i]), y);
      isDown = true;
    });
    pen.stroke();
    pen.fillText(`${label}, up to ${Number(highest.toPrecision(3))}`, 4 * scale, top + 11 * scale);
  });
  pen.fillStyle = '#1d2530';
  pen.fillRect(across(time) - scale / 2, 0, scale, height);
}
const jump = event => { pause(); seek(((event.offsetX / chart.clientWidth) - 0.01) / 0.98 * ends); };
chart.addEventListener('pointerdown', jump);
chart.addEventListener('pointermove', event => { if (event.buttons) jump(event); });

function draw() {
  renderer.render(scene, camera);
  placeLabels();  // rendering updates the camera's matrices
}
controls.addEventListener('change', draw);
function resize() {
  camera.aspect = view.clientWidth / Math.max(1, view.clientHeight);
  camera.updateProjectionMatrix();
  renderer.setSize(view.clientWidth, view.clientHeight);
  drawChart();
  draw();
}
window.addEventListener('resize', resize);

// ---- begin
if (window.flight) {
  hooks = await window.flight({data, unpack, scene, layer, layers, lines, placed, grid, surface, vehicle, showFigures, moveCamera, state});
  ends = hooks.ends;
} else {
  vehicle.add(new THREE.Mesh(new THREE.CylinderGeometry(0.06, 0.06, 0.1, 16).rotateX(Math.PI / 2), surface(0x2b3440, 1)));
  vehicle.add(new THREE.AxesHelper(0.6));
}
layer('roi', 'regions of interest', colors.roi, [roi.object]);
layer('rou', 'other returns', colors.rou, [rou.object]);
if (frames.some(frame => frame.boxes)) layer('boxes', 'nearest obstacles', colors.box, [boxes.object]);
if (frames.some(frame => frame.ground)) layer('ground', 'ground surface', colors.ground, [groundWires, groundFaces]);
if (flown) layer('flown', 'trajectory', colors.track, [flown.object]);
if (data.live) layer('directions', 'directions for the autopilot (green: free, orange: occupied, grey: unknown)', colors.free, [directions]);
byId('stages').open = window.matchMedia('(min-width: 900px) and (min-height: 700px)').matches;
byId('stages').hidden = !frames.some(frame => frame.image);
slider.max = String(ends);
const back = hooks ? [-10, -5, 6] : [-0.7, -0.35, 0.6].map(c => c * (data.zone_m || 20));
camera.position.set(...back);
controls.target.set(0, 0, 0);
controls.update();
resize();
if (data.live) {
  for (const id of ['play', 'time', 'speed']) byId(id).hidden = true;
  const source = new EventSource('events');
  let number = 0;
  source.onmessage = async ({data: text}) => {
    const frame = JSON.parse(text);
    apply(frame, await unpack(frame));
    byId('clock').textContent = 'live';
    state.frame = String(number++);
    draw();
  };
  source.onerror = () => { byId('clock').textContent = 'connection lost; retrying'; };
} else {
  // An address with #t=5 starts at 5 s; otherwise, the page begins with the first frame.
  const asked = window.location.hash.match(/^#t=([0-9.]+)$/);
  seek(asked ? Number(asked[1]) : times.length > 0 ? times[0] : 0);
}
})();
