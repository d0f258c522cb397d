'use strict';
// The interactive view of report.html: WebGL alone, nothing is loaded from elsewhere.
(function () {
  const data = JSON.parse(document.getElementById('data').textContent);
  const canvas = document.getElementById('view');
  const readout = document.getElementById('readout');
  const state = { color: 'height', exaggeration: data.exaggeration, azimuth: 215, elevation: 35, zoom: 1, pan: [0, 0], show: {} };

  function bytes(text) {
    const raw = atob(text);
    const out = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
    return out.buffer;
  }
  const floats = (text) => new Float32Array(bytes(text));
  const positions = floats(data.mesh.positions);
  const triangles = new Uint32Array(bytes(data.mesh.triangles));
  const fields = {};
  for (const f of data.fields) fields[f.name] = Object.assign({}, f, { values: floats(f.values) });
  const layers = data.faults.map((f) => ({ name: f.name, positions: floats(f.positions), triangles: new Uint32Array(bytes(f.triangles)) }));
  const picks = data.picks.map((p) => ({ name: p.name, color: p.color, positions: floats(p.positions) }));
  const up = data.down ? -1 : 1; // z of the data in the scene

  const gl = canvas.getContext('webgl', { antialias: true, preserveDrawingBuffer: true });
  const wide = gl && gl.getExtension('OES_element_index_uint');
  if (!gl || !wide) {
    readout.textContent = 'This browser has no WebGL: the view cannot be drawn; the pictures below show the same.';
    document.body.dataset.viewer = 'none';
    return;
  }

  function program(vertex, fragment) {
    const p = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const s = gl.createShader(type);
      gl.shaderSource(s, text);
      gl.compileShader(s);
      if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
      gl.attachShader(p, s);
    }
    gl.linkProgram(p);
    return p;
  }
  const surface = program(
    'attribute vec3 place; attribute vec3 normal; attribute vec3 tint; uniform mat4 camera; uniform float stretch; varying vec3 color;' +
    'void main() { vec3 n = normalize(vec3(normal.xy * stretch, normal.z)); float light = 0.45 + 0.6 * abs(dot(n, normalize(vec3(-1.0, 1.0, 1.4))));' +
    'color = tint * light; gl_Position = camera * vec4(place.xy, place.z * stretch, 1.0); }',
    'precision mediump float; varying vec3 color; uniform float opacity; void main() { gl_FragColor = vec4(color, opacity); }');
  const dots = program(
    'attribute vec3 place; uniform mat4 camera; uniform float stretch; uniform float size;' +
    'void main() { gl_Position = camera * vec4(place.xy, place.z * stretch, 1.0); gl_Position.z -= 0.0005; gl_PointSize = size; }',
    'precision mediump float; uniform vec3 tint; void main() { gl_FragColor = vec4(tint, 1.0); }');

  function buffer(type, values) {
    const b = gl.createBuffer();
    gl.bindBuffer(type, b);
    gl.bufferData(type, values, gl.STATIC_DRAW);
    return b;
  }
  function sceneOf(places) {
    const out = new Float32Array(places.length);
    for (let i = 0; i < places.length; i += 3) {
      out[i] = places[i];
      out[i + 1] = places[i + 1];
      out[i + 2] = up * places[i + 2];
    }
    return out;
  }
  function normalsOf(p, t) {
    const n = new Float32Array(p.length);
    for (let i = 0; i < t.length; i += 3) {
      const [a, b, c] = [3 * t[i], 3 * t[i + 1], 3 * t[i + 2]];
      const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      let w = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      if (w[2] < 0) w = w.map((x) => -x);
      for (const k of [a, b, c]) for (let d = 0; d < 3; ++d) n[k + d] += w[d];
    }
    return n;
  }
  function solid(places, t, tint) {
    const p = sceneOf(places);
    return { place: buffer(gl.ARRAY_BUFFER, p), normal: buffer(gl.ARRAY_BUFFER, normalsOf(p, t)), tint: buffer(gl.ARRAY_BUFFER, tint),
      triangles: buffer(gl.ELEMENT_ARRAY_BUFFER, t), count: t.length, points: p };
  }

  function scaleColor(scale, share) {
    const stops = data.scales[scale];
    const i = Math.round(Math.min(1, Math.max(0, share)) * (stops.length / 3 - 1));
    return [stops[3 * i] / 255, stops[3 * i + 1] / 255, stops[3 * i + 2] / 255];
  }
  function colorAt(field, value) {
    if (!isFinite(value)) return [0.7, 0.7, 0.7];
    if (field.scale === 'piece') {
      const n = data.pieces.length / 3, i = ((value % n) + n) % n;
      return [data.pieces[3 * i] / 255, data.pieces[3 * i + 1] / 255, data.pieces[3 * i + 2] / 255];
    }
    const share = (value - field.low) / (field.high - field.low || 1);
    return scaleColor(field.scale, field.reversed ? 1 - share : share);
  }
  function tints(name) {
    const field = fields[name], out = new Float32Array(positions.length);
    for (let i = 0; i < field.values.length; ++i) out.set(colorAt(field, field.values[i]), 3 * i);
    return out;
  }

  const ground = solid(positions, triangles, tints(state.color));
  const walls = layers.map((l) => {
    const tint = new Float32Array(l.positions.length);
    for (let i = 0; i < tint.length; i += 3) tint.set([0.72, 0.1, 0.14], i);
    return solid(l.positions, l.triangles, tint);
  });
  const clouds = picks.map((p) => ({ place: buffer(gl.ARRAY_BUFFER, sceneOf(p.positions)), count: p.positions.length / 3, color: p.color }));

  // A parallel projection: the scene's middle in the middle, turned, z stretched.
  let low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 3)
    for (let d = 0; d < 3; ++d) {
      const x = (d === 2 ? up : 1) * positions[i + d];
      low[d] = Math.min(low[d], x);
      high[d] = Math.max(high[d], x);
    }
  const middle = low.map((x, d) => 0.5 * (x + high[d]));
  const extent = 0.36 * Math.hypot(high[0] - low[0], high[1] - low[1]) || 1;
  function axes() {
    const a = state.azimuth * Math.PI / 180, e = state.elevation * Math.PI / 180;
    const viewer = [Math.sin(a) * Math.cos(e), Math.cos(a) * Math.cos(e), Math.sin(e)];
    const above = [-Math.sin(a) * Math.sin(e), -Math.cos(a) * Math.sin(e), Math.cos(e)];
    const right = [above[1] * viewer[2] - above[2] * viewer[1], above[2] * viewer[0] - above[0] * viewer[2], above[0] * viewer[1] - above[1] * viewer[0]];
    return [right, above, viewer];
  }
  function camera() {
    const s = state.zoom / extent, aspect = canvas.height / canvas.width;
    const [right, above, viewer] = axes();
    const c = [middle[0], middle[1], middle[2] * state.exaggeration];
    const dot = (u) => u[0] * c[0] + u[1] * c[1] + u[2] * c[2];
    const deep = 0.05 * s / state.zoom; // all of the scene in depth
    return new Float32Array([s * aspect * right[0], s * above[0], -deep * viewer[0], 0, s * aspect * right[1], s * above[1], -deep * viewer[1], 0,
      s * aspect * right[2], s * above[2], -deep * viewer[2], 0,
      -s * aspect * dot(right) + state.pan[0] * aspect, -s * dot(above) + state.pan[1], deep * dot(viewer), 1]);
  }

  function attribute(p, name, b) {
    const at = gl.getAttribLocation(p, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, b);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
  }
  function drawSolid(s, matrix, opacity) {
    gl.useProgram(surface);
    gl.uniformMatrix4fv(gl.getUniformLocation(surface, 'camera'), false, matrix);
    gl.uniform1f(gl.getUniformLocation(surface, 'stretch'), state.exaggeration);
    gl.uniform1f(gl.getUniformLocation(surface, 'opacity'), opacity);
    attribute(surface, 'place', s.place);
    attribute(surface, 'normal', s.normal);
    attribute(surface, 'tint', s.tint);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, s.triangles);
    gl.drawElements(gl.TRIANGLES, s.count, gl.UNSIGNED_INT, 0);
  }
  function draw() {
    const wanted = [Math.round(canvas.clientWidth * (window.devicePixelRatio || 1)), Math.round(canvas.clientHeight * (window.devicePixelRatio || 1))];
    if (canvas.width !== wanted[0] || canvas.height !== wanted[1]) [canvas.width, canvas.height] = wanted;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const matrix = camera();
    if (state.show.surface) drawSolid(ground, matrix, 1);
    gl.useProgram(dots);
    gl.uniformMatrix4fv(gl.getUniformLocation(dots, 'camera'), false, matrix);
    gl.uniform1f(gl.getUniformLocation(dots, 'stretch'), state.exaggeration);
    clouds.forEach((c, i) => {
      if (!state.show['picks' + i] || c.count === 0) return;
      gl.uniform1f(gl.getUniformLocation(dots, 'size'), i === 0 ? 2.5 : 6);
      gl.uniform3fv(gl.getUniformLocation(dots, 'tint'), c.color);
      attribute(dots, 'place', c.place);
      gl.drawArrays(gl.POINTS, 0, c.count);
    });
    if (state.show.faults) {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(false);
      walls.forEach((w) => drawSolid(w, matrix, 0.35));
      gl.depthMask(true);
      gl.disable(gl.BLEND);
    }
  }

  // What lies under a place of the canvas: the nearest triangle that a line of sight meets.
  function hit(x, y) {
    const [right, above, viewer] = axes();
    const s = state.zoom / extent;
    const c = [middle[0], middle[1], middle[2] * state.exaggeration];
    const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    const aspect = canvas.clientHeight / canvas.clientWidth;
    const px = ((2 * x / canvas.clientWidth - 1) / aspect - state.pan[0]) / s + dot(right, c);
    const py = (1 - 2 * y / canvas.clientHeight - state.pan[1]) / s + dot(above, c);
    const p = ground.points, e = state.exaggeration;
    let best = null;
    for (let t = 0; t < triangles.length; t += 3) {
      const q = [0, 1, 2].map((k) => {
        const i = 3 * triangles[t + k], v = [p[i], p[i + 1], p[i + 2] * e];
        return [dot(right, v) - px, dot(above, v) - py, dot(viewer, v)];
      });
      const edge = (a, b) => q[a][0] * q[b][1] - q[a][1] * q[b][0];
      const w = [edge(1, 2), edge(2, 0), edge(0, 1)], area = w[0] + w[1] + w[2];
      if (!(Math.abs(area) > 0) || w.some((x) => x / area < 0)) continue;
      const share = w.map((x) => x / area), depth = share[0] * q[0][2] + share[1] * q[1][2] + share[2] * q[2][2];
      if (!best || depth > best.depth) best = { depth, corners: [triangles[t], triangles[t + 1], triangles[t + 2]], share };
    }
    if (!best) return null;
    const mix = (values, stride, d) => best.corners.reduce((sum, v, k) => sum + best.share[k] * values[stride * v + d], 0);
    const found = { x: mix(positions, 3, 0) + data.origin[0], y: mix(positions, 3, 1) + data.origin[1], z: mix(positions, 3, 2) + data.origin[2] };
    const largest = best.share.indexOf(Math.max(...best.share));
    for (const f of data.fields) if (f.name !== 'height') found[f.name] = f.name === 'piece' ? fields.piece.values[best.corners[largest]] : mix(fields[f.name].values, 1, 0);
    let near = null;
    for (const f of data.throws)
      for (const r of f.rows) {
        const d = Math.hypot(r[0] - found.x, r[1] - found.y);
        if (!near || d < near.distance) near = { fault: f.name, distance: d, throw: r[2], sd: r[3] };
      }
    if (near) found.nearest = near;
    return found;
  }
  function number(x, digits) { return isFinite(x) && x !== null ? Number(x).toFixed(digits) : 'unknown'; }
  function say(found) {
    if (!found) { readout.textContent = 'No surface there.'; return; }
    const parts = ['x ' + number(found.x, 1), 'y ' + number(found.y, 1), 'z ' + number(found.z, 2) + ' ' + data.units.z];
    for (const f of data.fields)
      if (f.name !== 'height') parts.push(f.title + ' ' + (f.name === 'piece' ? found.piece + 1 : number(found[f.name], 2)));
    if (found.nearest)
      parts.push(found.nearest.fault + ' is ' + number(found.nearest.distance, 0) + ' ' + data.units.xy + ' away, throw there ' + number(found.nearest.throw, 1) +
        (found.nearest.sd !== null ? ' ± ' + number(found.nearest.sd, 1) : '') + ' ' + data.units.z);
    readout.textContent = parts.join(' · ');
  }

  function setColor(name) {
    state.color = name;
    gl.bindBuffer(gl.ARRAY_BUFFER, ground.tint);
    gl.bufferData(gl.ARRAY_BUFFER, tints(name), gl.STATIC_DRAW);
    const f = fields[name], bar = document.getElementById('bar');
    bar.replaceChildren();
    if (f.scale === 'piece') return draw();
    const steps = Array.from({ length: 33 }, (_, i) => 'rgb(' + colorAt(f, f.low + i / 32 * (f.high - f.low)).map((c) => Math.round(255 * c)).join(',') + ')');
    const strip = document.createElement('span');
    strip.style.background = 'linear-gradient(to right,' + steps.join(',') + ')';
    bar.append(number(f.low, f.digits), strip, number(f.high, f.digits) + ' ' + f.unit);
    draw();
  }

  const controls = document.getElementById('controls');
  function control(text, input) {
    const label = document.createElement('label');
    label.append(input, text);
    controls.append(label);
    return input;
  }
  const select = document.createElement('select');
  select.id = 'color';
  for (const f of data.fields) select.append(new Option(f.title, f.name));
  select.onchange = () => setColor(select.value);
  control(' colour', select);
  const slider = Object.assign(document.createElement('input'), { type: 'range', id: 'exaggeration', min: 0, max: 100, value: 100 * Math.log10(data.exaggeration) / 2.5 });
  const shown = document.createElement('output');
  function stretch(value) { state.exaggeration = value; shown.textContent = 'z × ' + number(value, 1); draw(); }
  slider.oninput = () => stretch(Math.pow(10, 2.5 * slider.value / 100));
  control(' ', slider).after(shown);
  function toggle(key, text, on) {
    const box = Object.assign(document.createElement('input'), { type: 'checkbox', checked: on, id: 'show-' + key });
    state.show[key] = on;
    box.onchange = () => { state.show[key] = box.checked; draw(); };
    control(' ' + text, box);
  }
  toggle('surface', 'surface', true);
  toggle('faults', 'faults', true);
  picks.forEach((p, i) => { if (p.positions.length) toggle('picks' + i, p.name + ' (' + p.positions.length / 3 + ')', i > 0); });

  let drag = null;
  canvas.onpointerdown = (e) => { drag = { x: e.clientX, y: e.clientY, moved: false, pan: e.shiftKey || e.button === 2 }; canvas.setPointerCapture(e.pointerId); };
  canvas.onpointermove = (e) => {
    if (!drag) return;
    const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
    if (!drag.moved && Math.hypot(dx, dy) < 3) return;
    drag.moved = true;
    [drag.x, drag.y] = [e.clientX, e.clientY];
    if (drag.pan) {
      state.pan[0] += 2 * dx / canvas.clientHeight;
      state.pan[1] -= 2 * dy / canvas.clientHeight;
    } else {
      state.azimuth += 0.4 * dx;
      state.elevation = Math.min(90, Math.max(-20, state.elevation + 0.4 * dy));
    }
    draw();
  };
  canvas.onpointerup = (e) => {
    if (drag && !drag.moved) { const r = canvas.getBoundingClientRect(); say(hit(e.clientX - r.left, e.clientY - r.top)); }
    drag = null;
  };
  canvas.oncontextmenu = (e) => e.preventDefault();
  canvas.onwheel = (e) => { e.preventDefault(); state.zoom *= Math.pow(1.0015, -e.deltaY); draw(); };
  window.onresize = draw;

  // report.html#check uses the view as a person would and writes down what came of it.
  function colored() {
    const p = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, p);
    let n = 0, sum = 0;
    for (let i = 0; i < p.length; i += 4) { if (p[i] + p[i + 1] + p[i + 2] < 740) ++n; sum = (sum * 31 + p[i] + 256 * p[i + 1] + p[i + 2]) % 1000003; }
    return { share: n / (canvas.width * canvas.height), sum };
  }
  function check() {
    const result = { colors: {}, error: gl.getError() };
    for (const f of data.fields) { select.value = f.name; select.onchange(); result.colors[f.name] = colored(); }
    select.value = 'height';
    select.onchange();
    const r = canvas.getBoundingClientRect();
    for (const dx of [0, 0.1, -0.1, 0.2, -0.2]) {
      const at = { clientX: r.left + (0.5 + dx) * r.width, clientY: r.top + 0.52 * r.height, bubbles: true, pointerId: 1 };
      drag = { x: at.clientX, y: at.clientY, moved: false };
      canvas.onpointerup(new PointerEvent('pointerup', at));
      if (!readout.textContent.startsWith('No surface')) break;
    }
    result.readout = readout.textContent;
    const before = colored();
    slider.value = slider.value > 50 ? 0 : 100;
    slider.oninput();
    result.stretched = colored().sum !== before.sum;
    slider.value = 100 * Math.log10(data.exaggeration) / 2.5;
    slider.oninput();
    const out = document.createElement('pre');
    out.id = 'check';
    out.textContent = JSON.stringify(result);
    document.body.append(out);
  }
  stretch(data.exaggeration);
  setColor('height');
  document.body.dataset.viewer = 'ready';
  if (location.hash === '#check') check();
})();
