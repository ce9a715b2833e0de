// Cloth that is kept beside the page's run, to be turned: pointer or arrow keys, + and - come nearer and go away.
// Without WebGL the picture above the figure is what there is.
(() => {
  const unpackPlanes = (bytes, count) => {  // byte planes of zigzag numbers
    const values = new Int32Array(count);
    for (let i = 0; i < count; ++i) {
      const z = bytes[i] | bytes[count + i] << 8 | bytes[2 * count + i] << 16 | bytes[3 * count + i] << 24;
      values[i] = z >>> 1 ^ -(z & 1);
    }
    return values;
  };
  const inflate = async bytes => new Uint8Array(
    await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer());
  const records = bytes => {
    const all = [];
    for (let at = 0; at < bytes.length;) {
      const end = bytes.indexOf(10, at), head = JSON.parse(new TextDecoder().decode(bytes.subarray(at, end)));
      at = end + 1;
      all.push({head, blocks: head.bytes.map(size => bytes.subarray(at, at += size))});
    }
    return all;
  };
  const trianglesOf = steps => {
    for (let i = 0; i < steps.length; ++i) steps[i] += i % 3 ? steps[i - i % 3] : i ? steps[i - 3] : 0;
    return steps;
  };
  // What each vertex is expected from: the corners of parallelograms, or neighbours of lower number.
  const cornersOf = (triangles, vertices) => {
    const first = new Map(), across = [...Array(vertices)].map(() => []), beside = across.map(() => []);
    for (let t = 0; t < triangles.length; t += 3)
      for (let k = 0; k < 3; ++k) {
        const p = triangles[t + k], q = triangles[t + (k + 1) % 3], c = triangles[t + (k + 2) % 3];
        const a = Math.min(p, q), b = Math.max(p, q), edge = a * vertices + b, other = first.get(edge);
        if (other === undefined) {
          first.set(edge, c);
          beside[b].push([a]);
        } else if (Math.max(c, other) > b) {
          across[Math.max(c, other)].push([a, b, Math.min(c, other)]);
        }
      }
    return across.map((corners, v) => corners.length ? corners : beside[v]);
  };
  const positionsOf = (rest, corners, quantum) => {
    const n = corners.length, x = new Float64Array(3 * n);
    for (let v = 0; v < n; ++v)
      for (let k = 0; k < 3; ++k) {
        let sum = 0;
        for (const [a, b, c] of corners[v]) sum += x[3 * a + k] + (b === undefined ? 0 : x[3 * b + k] - x[3 * c + k]);
        const expected = corners[v].length ? Math.floor(sum / corners[v].length) : v ? x[3 * v - 3 + k] : 0;
        x[3 * v + k] = expected + rest[k * n + v];
      }
    return x.map(step => step * quantum);
  };
  const normalsOf = (x, triangles) => {
    const n = new Float32Array(x.length);
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map(k => 3 * triangles[t + k]);
      const u = [0, 1, 2].map(k => x[b + k] - x[a + k]), w = [0, 1, 2].map(k => x[c + k] - x[a + k]);
      const normal = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
      for (const i of [a, b, c]) for (let k = 0; k < 3; ++k) n[i + k] += normal[k];
    }
    return n;
  };
  // Of a comparison each column's.
  async function clothsOf(text) {
    const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0)), meshes = [], cloths = [];
    for (const {head, blocks} of records(bytes)) {
      if (head.record === 'mesh') {
        const triangles = trianglesOf(unpackPlanes(await inflate(blocks[0]), 3 * head.triangles));
        meshes.push({triangles, quantum: head.quantum, corners: cornersOf(triangles, head.vertices)});
      } else if (head.record === 'cloth') {
        const setup = JSON.parse(new TextDecoder().decode(await inflate(blocks[0])));
        cloths.push({name: head.name, mesh: meshes[head.mesh], setup, instants: []});
      } else if (head.record === 'instant') {
        const {instants, mesh} = cloths[cloths.length - 1], {triangles, quantum, corners} = mesh;
        const x = positionsOf(unpackPlanes(await inflate(blocks[0]), 3 * corners.length), corners, quantum);
        instants.push({time: head.time, x, normals: normalsOf(x, triangles)});
      }
    }
    return cloths.filter(cloth => cloth.instants.length);
  }
  const programOf = gl => {
    const program = gl.createProgram(), add = (kind, text) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    };
    add(gl.VERTEX_SHADER, `attribute vec3 at, normal; uniform mat3 turn; uniform vec3 middle; uniform vec3 scale;
      varying vec3 n; void main() { vec3 p = scale * (turn * (at - middle)); n = turn * normal;
      gl_Position = vec4(p.xy, -0.5 * p.z, 1.0 - 0.2 * p.z); }`);
    add(gl.FRAGMENT_SHADER, `precision mediump float; varying vec3 n; void main() {
      vec3 m = normalize(gl_FrontFacing ? n : -n), cloth = gl_FrontFacing ? vec3(.14, .23, .38) : vec3(.3, .38, .48);
      float key = max(dot(m, normalize(vec3(-.8, .5, .35))), 0.), sky = .5 + .5 * m.y;
      gl_FragColor = vec4(pow(cloth * (1.5 * key + .45 * sky + .1), vec3(1. / 2.2)), 1); }`);
    gl.linkProgram(program);
    return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
  };
  // Rows: right, up and towards the eye, which stands at these angles.
  const axes = (around, above) => {
    const [c, s, d, e] = [Math.cos(around), Math.sin(around), Math.cos(above), Math.sin(above)];
    return [-s, c, 0, -e * c, -e * s, d, d * c, d * s, e];
  };
  const transposed = m => [m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]];

  function show(figure, cloths) {
    const canvas = document.createElement('canvas'), gl = canvas.getContext('webgl', {antialias: true, alpha: true});
    const program = gl && programOf(gl), wide = gl && gl.getExtension('OES_element_index_uint');
    if (!program || !wide || !cloths.length) return;
    let cloth = cloths[0];
    const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
    for (const {x} of cloths.flatMap(({instants}) => instants))
      x.forEach((value, i) => { low[i % 3] = Math.min(low[i % 3], value); high[i % 3] = Math.max(high[i % 3], value); });
    const middle = low.map((value, k) => (value + high[k]) / 2);
    const radius = Math.hypot(...low.map((value, k) => high[k] - value)) / 2;
    const eye = cloth.setup.options.camera.direction;
    let around = Math.atan2(eye[1], eye[0]), above = Math.atan2(eye[2], Math.hypot(eye[0], eye[1])), zoom = 1;
    let now = cloth.instants.length - 1, held = null;
    const buffers = {}, bind = (data, name, target = gl.ARRAY_BUFFER) => {
      gl.bindBuffer(target, buffers[name] ??= gl.createBuffer());
      gl.bufferData(target, data, gl.STATIC_DRAW);
      if (target !== gl.ARRAY_BUFFER) return;
      const place = gl.getAttribLocation(program, name);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    };
    const take = () => {
      const {x, normals} = cloth.instants[Math.min(now, cloth.instants.length - 1)];
      bind(new Float32Array(x), 'at');
      bind(normals, 'normal');
      bind(new Uint32Array(cloth.mesh.triangles), 'triangles', gl.ELEMENT_ARRAY_BUFFER);
    };
    const place = name => gl.getUniformLocation(program, name);
    const draw = () => {
      const width = canvas.clientWidth * devicePixelRatio, height = canvas.clientHeight * devicePixelRatio;
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      const size = zoom / radius, narrow = Math.min(1, canvas.width / canvas.height);
      gl.uniformMatrix3fv(place('turn'), false, transposed(axes(around, above)));
      gl.uniform3fv(place('middle'), middle);
      gl.uniform3f(place('scale'), size * narrow * canvas.height / canvas.width, size * narrow, 1 / radius);
      gl.drawElements(gl.TRIANGLES, cloth.mesh.triangles.length, gl.UNSIGNED_INT, 0);
    };
    const turn = (x, y) => {
      around -= x;
      above = Math.max(-1.55, Math.min(1.55, above + y));
      draw();
    };
    const come = factor => { zoom = Math.max(.4, Math.min(12, zoom * factor)); draw(); };
    Object.assign(canvas, {tabIndex: 0, onpointerdown: event => {
      held = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    }, onpointermove: event => {
      if (!held) return;
      turn((event.clientX - held[0]) / 120, (event.clientY - held[1]) / 120);
      held = [event.clientX, event.clientY];
    }, onpointerup: () => { held = null; }, onpointercancel: () => { held = null; }, onkeydown: event => {
      const step = {ArrowLeft: [-.1, 0], ArrowRight: [.1, 0], ArrowUp: [0, .1], ArrowDown: [0, -.1]}[event.key];
      const factor = {'+': 1.2, '=': 1.2, '-': 1 / 1.2}[event.key];
      if (!step && !factor) return;
      event.preventDefault();
      step ? turn(...step) : come(factor);
    }});
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'cloth, turned by arrow keys or by dragging');
    canvas.addEventListener('wheel', event => {
      if (!event.ctrlKey) return;  // the page scrolls
      event.preventDefault();
      come(Math.exp(-event.deltaY / 300));
    }, {passive: false});
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    figure.prepend(canvas);
    figure.hidden = false;
    const bar = Object.assign(document.createElement('div'), {className: 'controls'});
    const words = document.createElement('span'), slider = Object.assign(document.createElement('input'),
      {type: 'range', min: 0, max: now, value: now, ariaLabel: 'instant'});
    const names = Object.assign(document.createElement('select'), {ariaLabel: 'column'});
    const change = () => {
      now = +slider.value;
      words.textContent = cloth.instants[Math.min(now, cloth.instants.length - 1)].time.toFixed(2) + ' s';
      take();
      draw();
    };
    cloths.forEach(({name}) => names.append(new Option(name)));
    names.onchange = () => { cloth = cloths[names.selectedIndex]; change(); };
    slider.oninput = change;
    if (cloths.length > 1) bar.append(names);
    if (now > 0) bar.append(slider, words);
    canvas.after(bar);
    change();
    new ResizeObserver(draw).observe(canvas);
  }
  for (const figure of document.querySelectorAll('figure.turn'))
    clothsOf(figure.querySelector('script').textContent).then(cloths => show(figure, cloths), () => {});
})();
