// The drawing by the graphics processor: WebGL 2.

const vertexShader = `#version 300 es
precision highp float;
precision highp int;
in vec3 place;
in uvec4 classes;
uniform vec4 right, up, back;
uniform vec2 size, heights, shift;
uniform int mode, mask;
uniform ivec3 range;
uniform float faint, depth;
uniform sampler2D palette;
uniform vec4 fixedColour;
flat out vec4 colour;
void main() {
  vec4 p = vec4(place, 1.0);
  gl_Position = vec4((dot(right, p) + shift.x) * 2.0 / size.x, (dot(up, p) + shift.y) * 2.0 / size.y, -dot(back, p) / depth, 1.0);
  int kind = int(classes.x & 7u);
  float shade = float(classes.x >> 3u) / 31.0;
  float level = (place.z - heights.x) / max(heights.y - heights.x, 1e-6);
  int entry = mode == 0 ? kind : mode == 1 ? int(classes.y) : mode == 2 ? int(classes.z) : mode == 3 ? int(classes.w) : int(clamp(level, 0.0, 1.0) * 255.0);
  colour = fixedColour.a > 0.0 ? fixedColour : texelFetch(palette, ivec2(entry, 0), 0);
  colour.rgb *= kind == 0 || kind == 4 ? 1.0 : shade;
  if (kind == 0) colour.a *= 0.55;
  if (gl_VertexID < range.x || gl_VertexID >= range.y || gl_VertexID > range.z) colour.a *= faint;
  if (kind == 7 || (mask >> kind & 1) == 0) colour.a = 0.0;
}`;

const fragmentShader = `#version 300 es
precision mediump float;
flat in vec4 colour;
out vec4 result;
void main() {
  if (colour.a < 0.02) discard;
  result = vec4(colour.rgb * colour.a, colour.a);
}`;

/** Whether the processor has to do the work of a graphics unit. */
function isSoftware() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

/** Corners of a path whose lines are drawn wider. */
const mostWideCorners = 60_000;

/** Draws the curves of a path as strips of lines; flat colours come from the corner at which a line ends. */
class GlScene {
  /** Null where there is no WebGL 2. */
  static on(canvas) {
    // Smooth edges cost a processor without a graphics unit three times as much.
    const gl = canvas.getContext('webgl2', {
      antialias: !isSoftware(),
      alpha: true,
      powerPreference: 'high-performance'
    });
    if (!gl) return null;
    try {
      return new GlScene(canvas, gl);
    } catch (error) {
      console.warn('ncvet:', error.message);
      return null;
    }
  }

  constructor(canvas, gl) {
    this.canvas = canvas;
    this.gl = gl;
    this.isSlow = !gl.getContextAttributes().antialias;
    this.program = linked(gl);
    this.at = {};
    for (const name of [
      'right',
      'up',
      'back',
      'size',
      'heights',
      'shift',
      'mode',
      'mask',
      'range',
      'faint',
      'depth',
      'palette',
      'fixedColour'
    ])
      this.at[name] = gl.getUniformLocation(this.program, name);
    this.palette = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.curves = [];
  }

  setPalette(bytes) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  }

  /** Takes drawings in the place of the ones before. */
  setCurves(curves) {
    const { gl } = this;
    for (const old of this.curves) {
      gl.deleteVertexArray(old.array);
      old.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    }
    this.curves = curves.map(({ drawn, levels }) => {
      const array = gl.createVertexArray(),
        buffers = [];
      gl.bindVertexArray(array);
      const upload = (data) => {
        const buffer = gl.createBuffer();
        buffers.push(buffer);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      };
      // A place that is unknown is hidden, but must be a number.
      upload(drawn.places.map((x) => (Number.isFinite(x) ? x : 0)));
      gl.enableVertexAttribArray(0);
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
      upload(drawn.classes);
      gl.enableVertexAttribArray(1);
      gl.vertexAttribIPointer(1, 4, gl.UNSIGNED_BYTE, 0, 0);
      return { array, buffers, drawn, levels, indexes: [], thinned: new Map() };
    });
  }

  indexOf(curve, level) {
    const { gl } = this;
    if (!curve.indexes[level]) {
      const buffer = gl.createBuffer();
      curve.buffers.push(buffer);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, curve.levels.levels[level].index, gl.STATIC_DRAW);
      curve.indexes[level] = buffer;
    }
    return curve.indexes[level];
  }

  /** The buffer of a level in which most pieces are left out, and how many indexes it has. */
  thinnedOf(curve, level, sparse) {
    const { gl } = this,
      key = level * 1024 + sparse;
    if (!curve.thinned.has(key)) {
      const buffer = gl.createBuffer(),
        index = curve.levels.thinned(level, sparse);
      curve.buffers.push(buffer);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, index, gl.STATIC_DRAW);
      curve.thinned.set(key, { buffer, count: index.length });
    }
    return curve.thinned.get(key);
  }

  /** Draws one frame; returns how many corners it had. */
  draw(view) {
    const { gl, at, canvas } = this,
      { camera } = view;
    const ratio = canvas.width / view.width;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.program);
    const rows = camera.rows();
    gl.uniform4fv(at.right, rows[0]);
    gl.uniform4fv(at.up, rows[1]);
    gl.uniform4fv(at.back, rows[2]);
    gl.uniform2f(at.size, view.width, view.height);
    gl.uniform2f(at.heights, view.heights[0], view.heights[1]);
    gl.uniform1i(at.palette, 0);
    let corners = 0;
    this.curves.forEach((curve, i) => {
      const isCentre = i > 0;
      if (isCentre && !view.showCentre) return;
      gl.uniform1f(
        at.depth,
        Math.max(1, curve.levels.size * camera.scale * 4 + Math.hypot(view.width, view.height))
      );
      gl.uniform1i(at.mode, isCentre ? 0 : view.mode);
      gl.uniform1i(at.mask, view.mask);
      gl.uniform3i(
        at.range,
        ...(isCentre ? view.centreRange : view.range),
        isCentre ? view.centreLimit : view.limit
      );
      gl.uniform1f(at.faint, view.faint);
      gl.uniform4f(at.fixedColour, ...view.centreColour.map((x) => x / 255), isCentre ? 1 : 0);
      gl.bindVertexArray(curve.array);
      // Lines are one pixel wide everywhere: a short path is drawn again beside itself.
      const isShort = curve.drawn.count < mostWideCorners;
      for (const [right, up] of isShort
        ? [
            [0, 0],
            [0.8, 0],
            [0, 0.8]
          ]
        : [[0, 0]]) {
        gl.uniform2f(at.shift, right / ratio, up / ratio);
        corners += this.drawCurve(curve, view, ratio);
      }
    });
    gl.bindVertexArray(null);
    return corners;
  }

  drawCurve(curve, view, ratio) {
    const { gl } = this,
      { levels } = curve;
    const level = levels.choose(view.away / (view.camera.scale * ratio));
    if (view.sparse > 1) {
      const { buffer, count } = this.thinnedOf(curve, level, view.sparse);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
      gl.drawElements(gl.LINES, count, gl.UNSIGNED_INT, 0);
      return count / 2;
    }
    let corners = 0;
    if (level > 0) gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indexOf(curve, level));
    for (const [first, last] of levels.visible(view.camera, view.width, view.height, view.sparse)) {
      if (level === 0) {
        const begin = Math.max(0, levels.starts[first] - 1),
          count = levels.starts[last] - begin;
        gl.drawArrays(gl.LINE_STRIP, begin, count);
        corners += count;
      } else {
        const { begins } = levels.levels[level],
          begin = Math.max(0, begins[first] - 1),
          count = begins[last] - begin;
        gl.drawElements(gl.LINE_STRIP, count, gl.UNSIGNED_INT, begin * 4);
        corners += count;
      }
    }
    return corners;
  }

  /** Waits until a frame is drawn: for measurements alone. */
  finish() {
    const pixel = new Uint8Array(4);
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, pixel);
  }
}

function linked(gl) {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, vertexShader],
    [gl.FRAGMENT_SHADER, fragmentShader]
  ]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.bindAttribLocation(program, 0, 'place');
  gl.bindAttribLocation(program, 1, 'classes');
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS))
    throw new Error(gl.getProgramInfoLog(program) || 'the drawing cannot be set up');
  return program;
}
