// SPDX-License-Identifier: BSD-3-Clause
// Draws the solids of spatial mechanisms with WebGL. page.c inserts this script into the pages of spatial mechanisms.
// Each mesh is drawn once for each of its instances, with the axes of the instance. Meshes that many shapes share have unit
// size. The picture is then copied into the stage.

// ---- shaders: a vertex is at centre + p.x x + p.y y + p.z z + p.w along, so `along` stretches a capsule ----

const PASSES = {SHADOW: 0, SOLID: 1, CREASES: 2, OUTLINE: 3};
const ATTRIBUTES = {p: 4, normal: 3, outward: 3, x: 3, y: 3, z: 3, centre: 3, along: 3, fill: 3, edge: 3};
const VERTEX = 10, INSTANCE = 21; // numbers in a vertex (the first three attributes) and in an instance (the other attributes)
const VERTEX_SHADER = `#version 300 es
in vec4 p;
in vec3 normal, outward, x, y, z, centre, along, fill, edge;
uniform mat3 axes;
uniform vec4 bottom, window; // bottom: upward direction and height of the floor; window: factors and shift from metres to the picture
uniform vec3 middle;
uniform vec2 measures; // range of depths, and half the width of an outline [m]
uniform int pass;
out vec3 facing, colour, sky;
vec3 turned(vec3 n) { return axes * (x * n.x / dot(x, x) + y * n.y / dot(y, y) + z * n.z / dot(z, z)); }
void main() {
  vec3 place = centre + x * p.x + y * p.y + z * p.z + along * p.w;
  if (pass == ${PASSES.SHADOW}) place -= bottom.xyz * (dot(place, bottom.xyz) - bottom.w);
  vec3 at = axes * (place - middle);
  if (pass == ${PASSES.CREASES} || pass == ${PASSES.OUTLINE}) at += measures.y * normalize(turned(outward));
  gl_Position = vec4(at.xy * window.xy + window.zw, pass == ${PASSES.SHADOW} ? .999 : -at.z / measures.x, 1);
  facing = turned(normal);
  sky = axes * bottom.xyz;
  colour = pass == ${PASSES.SOLID} ? fill : edge;
}`;
const FRAGMENT_SHADER = `#version 300 es
precision highp float;
precision highp int;
in vec3 facing, colour, sky;
uniform int pass;
uniform vec3 shadow;
out vec4 result;
void main() {
  vec3 n = normalize(gl_FrontFacing ? facing : -facing);
  float light = pass == ${PASSES.SOLID} ? .8 + .16 * dot(n, sky) + .14 * dot(n, vec3(-.4, .3, .87)) : 1.;
  result = pass == ${PASSES.SHADOW} ? vec4(.7 * shadow, .7) : vec4(min(colour * light, 1.), 1);
}`;

// ---- meshes ----

// Makes triangles with normals. Edges are smooth if their faces meet at less than 45 degrees, and sharp otherwise.
function makeMesh(points, triangles) {
  const at = points.map(([x, y, z, w = 0]) => [x, y, z + 4 * w]), size = at.reduce((most, p) => Math.max(most, Math.hypot(...p)), 0);
  const first = new Map(), same = points.map((p, k) => { // index of the first point at the same place
    const key = p.map(e => Math.round(1e6 * e / size)).join(' ');
    return first.get(key) ?? (first.set(key, k), k);
  });
  const less = (a, b) => at[a].map((e, i) => e - at[b][i]), area = ([a, b, c]) => cross(less(b, a), less(c, a));
  const faces = triangles.map(face => face.map(k => same[k])).filter(face => Math.hypot(...area(face)) > 0);
  if (faces.reduce((volume, face) => volume + dot(area(face), at[face[0]]), 0) < 0) faces.forEach(face => face.reverse());
  const normals = faces.map(face => normal(area(face))), around = points.map(() => []), beside = new Map();
  faces.forEach((face, k) => face.forEach((a, i) => {
    around[a].push(normals[k]);
    beside.set(a * points.length + face[(i + 1) % 3], normals[k]);
  }));
  const mean = list => normal(list.reduce((sum, n) => [sum[0] + n[0], sum[1] + n[1], sum[2] + n[2]], [0, 0, 1e-9]));
  const vertices = [], outward = around.map(mean), add = (k, smooth) => {
    const [x, y, z, w = 0] = points[k];
    vertices.push(x, y, z, w, ...smooth, ...outward[k]);
  };
  faces.forEach((face, k) => face.forEach(a => add(a, mean(around[a].filter(n => dot(n, normals[k]) > .7)))));
  const corners = vertices.length / VERTEX;
  beside.forEach((n, side) => {
    const a = Math.floor(side / points.length), b = side % points.length, other = beside.get(b * points.length + a);
    if (!other || (a < b && dot(n, other) < .7)) { add(a, n); add(b, n); }
  });
  return {vertices: new Float32Array(vertices), corners, ends: vertices.length / VERTEX - corners, instances: []};
}
// Makes a surface through rings that have the same number of points. More triangles may be added.
function makeRings(rings, triangles = []) {
  const n = rings[0].length, sides = rings.slice(1).flatMap((_, k) => rings[0].flatMap((_, j) => {
    const a = k * n + j, b = k * n + (j + 1) % n;
    return [[a, b, b + n], [a, b + n, a + n]];
  }));
  return makeMesh(rings.flat(), [...sides, ...triangles]);
}
const ring = (radius, z, w, count = 24) => Array.from({length: count}, (_, k) =>
  [radius * Math.cos(2 * Math.PI * (k + .5) / count), radius * Math.sin(2 * Math.PI * (k + .5) / count), z, w]);
const makeDrum = (count, radius, z, w) => makeRings([[0, -1], [radius, -1], [radius, 1], [0, 1]].map(([r, end]) => ring(r, end * z, end * w, count)));
function makeCapsule() {
  const half = [-90, -65, -40, -20, 0].map(a => [Math.cos(a * Math.PI / 180), Math.sin(a * Math.PI / 180)]);
  return makeRings([...half.map(([r, z]) => ring(r, z, -1)), ...half.reverse().map(([r, z]) => ring(r, -z, 1))]);
}
const WIRE = .13; // radius of the wire, as a fraction of the radius of a coil
function makeCoil(revolutions = 6, steps = 72) {
  return makeRings(Array.from({length: steps + 1}, (_, k) => ring(WIRE, 0, 0, 5).map(([a, b]) => {
    const angle = 2 * Math.PI * revolutions * k / steps;
    return [(1 + a) * Math.cos(angle), (1 + a) * Math.sin(angle), -b, 2 * k / steps - 1];
  })));
}
// Divides a simple planar polygon into triangles by cutting off its ears. Its points are in counter-clockwise order.
function triangulate(xy) {
  const left = xy.map((_, k) => k), triangles = [];
  const turn = (a, b, c) => (xy[b][0] - xy[a][0]) * (xy[c][1] - xy[a][1]) - (xy[b][1] - xy[a][1]) * (xy[c][0] - xy[a][0]);
  const isEar = ([a, b, c]) => turn(a, b, c) > 0 &&
    left.every(k => k === a || k === b || k === c || turn(a, b, k) < 0 || turn(b, c, k) < 0 || turn(c, a, k) < 0);
  const corner = (_, k) => [left.at(k - 1), left[k], left[(k + 1) % left.length]];
  while (left.length > 2) {
    const ear = Math.max(left.map(corner).findIndex(isEar), 0);
    triangles.push(corner(null, ear));
    left.splice(ear, 1);
  }
  return triangles;
}
function makePlate(points, thickness) {
  const n = normal(points.reduce((sum, p, k) => cross(points.at(k - 1), p).map((e, i) => sum[i] + e), [0, 0, 0])), [x, y] = across(n);
  const levels = [-.5, .5].map(share => points.map(p => p.map((e, i) => e + share * thickness * n[i])));
  const top = triangulate(points.map(p => [dot(p, x), dot(p, y)]));
  return makeRings(levels, [...top.map(([a, b, c]) => [a, c, b]), ...top.map(face => face.map(k => k + points.length))]);
}

// ---- the shapes of a frame, as instances of meshes ----

const parsed = new Map(); // colours that have been converted: red, green and blue from 0 to 1
function rgb(colour) {
  if (!parsed.has(colour)) parsed.set(colour, [1, 3, 5].map(k => parseInt(colour.slice(k, k + 2), 16) / 255));
  return parsed.get(colour);
}
function ownMesh(shape, make) {
  if (!solids.own.has(shape)) solids.own.set(shape, make());
  return solids.own.get(shape);
}
const put = (mesh, axes, centre, along, tone) => mesh.instances.push(...axes.flat(), ...centre, ...along, ...tone);
const mix = (a, b, share) => a.map((e, i) => e + share * (b[i] - e));
function putTube(mesh, from, to, radius, tone) {
  const along = to.map((e, i) => (e - from[i]) / 2), z = Math.hypot(...along) > 0 ? normal(along) : [0, 0, 1];
  const axes = [...across(z), z].map(axis => axis.map(e => radius * e));
  put(mesh, axes, mix(from, to, .5), along, tone);
  return axes[0];
}
function putChain(points, radius, tone, closed) {
  points.forEach((p, k) => { if (k || closed) putTube(solids.capsule, points.at(k - 1), p, radius, tone); });
}
function putBetween({style, radius}, from, to, thin, tone) {
  const part = (mesh, a, b, size) => putTube(mesh, mix(from, to, a), mix(from, to, b), size, tone);
  if (style === 'spring') {
    const out = part(solids.coil, .15, .85, radius);
    for (const [end, share] of [[from, .15], [to, .85]]) {
      const near = mix(from, to, share);
      putChain([end, near, near.map((e, i) => e + out[i])], WIRE * radius, tone);
    }
  } else if (style === 'damper') {
    part(solids.capsule, 0, 1, .25 * radius);
    part(solids.cylinder, .3, .6, radius);
  } else part(solids.capsule, 0, 1, Math.max(radius, thin));
}
function putDisc({points: [centre, n], radius}, f, fill, thin, tone) {
  const axis = turned(f.a, normal(n)), middle = moved(f, centre), [x, y] = across(axis);
  const end = side => middle.map((e, i) => e + side * .4 * unit * axis[i]);
  if (fill) putTube(solids.cylinder, end(-1), end(1), radius, tone);
  else putChain(ring(radius, 0, 0, 32).map(([a, b]) => middle.map((e, i) => e + a * x[i] + b * y[i])), thin, tone, true);
}
function putSolid(shape, frames) {
  const {form, style, body, radius} = shape, f = frames[body], {fill, edge, width} = look(shape), tone = [...rgb(fill || edge), ...rgb(edge)];
  const points = form === 'mesh' ? [] : shape.points.map(p => moved(f, p)), thin = .5 * width / view.scale, none = [0, 0, 0];
  const wide = Math.max(radius * (1 + .02 * (3 * body % 8)), thin); // lines of different bodies differ in width, so that they remain distinguishable at one place
  const axes = [0, 1, 2].map(k => [f.a[k], f.a[3 + k], f.a[6 + k]]);
  if (form === 'ball') putTube(solids.capsule, points[0], points[0], radius, tone);
  else if (form === 'disc') putDisc(shape, f, fill, thin, tone);
  else if (form === 'between') putBetween(shape, points[0], moved(frames[shape.other], shape.points[1]), thin, tone);
  else if (form === 'box') put(solids.cube, axes.map((axis, k) => axis.map(e => e * Math.max(shape.points[1][k], .02 * unit))), points[0], none, tone);
  else if (form === 'mesh') put(ownMesh(shape, () => makeMesh(shape.points, inThrees(shape.triangles))), axes, f.r, none, tone);
  else if (form === 'area') {
    put(ownMesh(shape, () => makePlate(shape.points, 2 * radius || .6 * unit)), axes, f.r, none, tone);
    if (radius) putChain(points, radius, tone, true);
  } else if (form === 'cylinder') putTube(solids.cylinder, ...points, radius, tone);
  else if (points.length === 2 && style !== 'body') putTube(solids.cylinder, ...points, wide, tone);
  else putChain(points, wide, tone);
}
const inThrees = list => Array.from({length: list.length / 3}, (_, k) => list.slice(3 * k, 3 * k + 3));

// ---- WebGL ----

function startSolids(canvas = document.createElement('canvas')) {
  const gl = canvas.getContext('webgl2');
  if (!gl) return;
  const program = gl.createProgram(), uniforms = {};
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX_SHADER], [gl.FRAGMENT_SHADER, FRAGMENT_SHADER]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  Object.keys(ATTRIBUTES).forEach((name, k) => gl.bindAttribLocation(program, k, name));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return;
  gl.useProgram(program);
  gl.enable(gl.DEPTH_TEST);
  gl.cullFace(gl.FRONT);
  for (const name of ['axes', 'middle', 'bottom', 'window', 'measures', 'pass', 'shadow']) uniforms[name] = gl.getUniformLocation(program, name);
  solids = {gl, canvas, uniforms, own: new Map(), capsule: makeCapsule(), coil: makeCoil(), cube: makeDrum(4, Math.SQRT2, 1, 0), cylinder: makeDrum(24, 1, 0, 1)};
  canvas.addEventListener('webglcontextlost', event => { event.preventDefault(); solids = null; redraw(); }, {once: true});
  canvas.addEventListener('webglcontextrestored', () => { startSolids(canvas); redraw(); }, {once: true});
}
function upload(gl, mesh) {
  if (!mesh.array) {
    mesh.array = gl.createVertexArray();
    gl.bindVertexArray(mesh.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, mesh.vertices, gl.STATIC_DRAW);
    let offset = 0;
    Object.values(ATTRIBUTES).forEach((size, k) => {
      if (offset === VERTEX) { // the other attributes are in another buffer, once for each instance
        gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer = gl.createBuffer());
        offset = 0;
      }
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, size, gl.FLOAT, false, 4 * (mesh.buffer ? INSTANCE : VERTEX), 4 * offset);
      gl.vertexAttribDivisor(k, mesh.buffer ? 1 : 0);
      offset += size;
    });
  }
  gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffer);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(mesh.instances), gl.DYNAMIC_DRAW);
}
function setView({gl, uniforms, canvas}) {
  const {axes, scale, centre, shift} = view, [w, h] = [Math.max(stage.width, 1), Math.max(stage.height, 1)];
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  gl.viewport(0, 0, w, h);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.uniformMatrix3fv(uniforms.axes, true, axes);
  gl.uniform3fv(uniforms.middle, centre);
  gl.uniform4f(uniforms.bottom, ...UP, floor.height);
  gl.uniform4f(uniforms.window, 2 * scale / wide, 2 * scale / high, 2 * shift[0] / wide, -2 * shift[1] / high);
  gl.uniform2f(uniforms.measures, 5 * floor.size, 1.3 / scale); // a large range, because bodies in a live page may leave the floor
  gl.uniform3fv(uniforms.shadow, rgb(colours.shadow));
}
function drawSolids(frames) {
  const {gl, canvas, uniforms, own, capsule, cylinder, cube, coil} = solids, all = () => [capsule, cylinder, cube, coil, ...own.values()];
  all().forEach(mesh => { mesh.instances.length = 0; });
  for (const shape of shapes) if (!TOP.includes(shape.style)) putSolid(shape, frames);
  const meshes = all().filter(mesh => mesh.instances.length);
  setView(solids);
  meshes.forEach(mesh => upload(gl, mesh));
  for (const pass of Object.values(PASSES)) {
    if (pass === PASSES.SHADOW && view.tilt <= 0) continue; // the floor is seen from below
    gl.uniform1i(uniforms.pass, pass);
    if (pass === PASSES.OUTLINE) gl.enable(gl.CULL_FACE); else gl.disable(gl.CULL_FACE);
    for (const mesh of meshes) {
      const creases = pass === PASSES.CREASES;
      gl.bindVertexArray(mesh.array);
      gl.drawArraysInstanced(creases ? gl.LINES : gl.TRIANGLES, creases ? mesh.corners : 0, creases ? mesh.ends : mesh.corners, mesh.instances.length / INSTANCE);
    }
  }
  pen.drawImage(canvas, 0, 0, wide, high);
}

// ---- the floor, which consists of squares below the whole motion ----

const floor = {height: 0, size: 1, square: 1, low: [0, 0], up: [0, 0]};
function fitFloor() {
  const {low, up} = extents([...X, ...Y, ...UP]), grid = (e, to) => floor.square * to(e / floor.square);
  floor.size = Math.max(...low.map((e, i) => up[i] - e), 4 * unit);
  floor.height = low[2] - .5 * unit;
  floor.square = round(Math.max(up[0] - low[0], up[1] - low[1], 4 * unit) / 4);
  [floor.low, floor.up] = [[0, 1].map(i => grid(low[i], Math.floor)), [0, 1].map(i => grid(up[i], Math.ceil))];
}
function drawFloor() {
  const {height, low, up, square} = floor, corner = (a, b) => project(UP.map((e, i) => a * X[i] + b * Y[i] + height * e));
  for (let a = low[0]; a < up[0] + .5 * square; a += square) { path([corner(a, low[1]), corner(a, up[1])]); stroke(1, colours.rule, []); }
  for (let b = low[1]; b < up[1] + .5 * square; b += square) { path([corner(low[0], b), corner(up[0], b)]); stroke(1, colours.rule, []); }
}
