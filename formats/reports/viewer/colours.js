// Colours of the drawing, on a light and on a dark ground.

const colourModes = { motion: 0, tool: 1, operation: 2, feed: 3, height: 4 };

/** 256 colours, four bytes each, for one way of colouring. */
function paletteOf(mode, isDark) {
  const bytes = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; ++i) bytes.set([...colourOf(mode, i, isDark), 255], i * 4);
  return bytes;
}

function colourOf(mode, i, isDark) {
  if (mode === 'motion') return (isDark ? motionsOnDark : motionsOnLight)[Math.min(i, 5)];
  if (mode === 'feed' || mode === 'height') return rampColour(i / 255, isDark);
  // Neighbours differ by the golden angle.
  return fromHue(
    (i * 137.508 + 205) % 360,
    isDark ? 0.72 : 0.78,
    isDark ? 0.64 - 0.1 * (i % 3 === 1) : 0.42 + 0.06 * (i % 3)
  );
}

const motionsOnLight = [
  [214, 84, 50],
  [24, 95, 190],
  [0, 122, 112],
  [122, 62, 176],
  [196, 26, 140],
  [90, 90, 90]
];
const motionsOnDark = [
  [240, 128, 84],
  [98, 172, 255],
  [64, 208, 184],
  [188, 140, 255],
  [255, 110, 200],
  [170, 170, 170]
];

/** From blue over green to red. */
function rampColour(part, isDark) {
  return fromHue(240 * (1 - part), isDark ? 0.78 : 0.85, isDark ? 0.62 : 0.44);
}

function fromHue(hue, saturation, lightness) {
  const chroma = saturation * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map((n) => {
    const k = (n + hue / 30) % 12;
    return Math.round(255 * (lightness - chroma * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  });
}

function cssColour([r, g, b]) {
  return `rgb(${r}, ${g}, ${b})`;
}
