// Brings a drawing of which some corners are others to the graphics unit.

/** Corners that a buffer has room for beside those that are there, so that an edit needs no new one. */
const spareCorners = 65536;

/** Places that are unknown are hidden, but must be numbers. */
function plainNumbers(places) {
  const plain = places.slice();
  for (let i = 0; i < plain.length; ++i) if (!Number.isFinite(plain[i])) plain[i] = 0;
  return plain;
}

/** `change`: what `splicePath` has returned of these curves. */
function uploadChange(scene, curves, { corners, isRecoloured }) {
  if (!scene.gl || curves.length > 1) return scene.setCurves(curves);
  const { gl } = scene,
    curve = scene.curves[0],
    { drawn } = curves[0];
  for (const buffer of curve.buffers.slice(2)) gl.deleteBuffer(buffer);
  curve.buffers.length = 2;
  curve.indexes = [];
  curve.thinned.clear();
  const isMoved = corners.removed !== corners.added,
    isTooSmall = drawn.count > (curve.room ?? drawn.count - corners.added + corners.removed);
  if (isTooSmall) curve.room = drawn.count + spareCorners;
  const put = (buffer, data, width, bytes, from) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    if (isTooSmall) gl.bufferData(gl.ARRAY_BUFFER, curve.room * width * bytes, gl.DYNAMIC_DRAW);
    const first = isTooSmall ? 0 : from,
      last = isTooSmall || isMoved || first === 0 ? drawn.count : corners.first + corners.added;
    const piece = data.subarray(first * width, last * width);
    gl.bufferSubData(gl.ARRAY_BUFFER, first * width * bytes, bytes === 4 ? plainNumbers(piece) : piece);
  };
  put(curve.buffers[0], drawn.places, 3, 4, corners.first);
  put(curve.buffers[1], drawn.classes, 4, 1, isRecoloured ? 0 : corners.first);
}
