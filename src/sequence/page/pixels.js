// Scene-linear pixels: from the pictures in this file to numbers, and from numbers to what is shown.

const halfOf = (bits) => {
  const sign = bits >> 15 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const mantissa = bits & 1023;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return exponent === 0 ? sign * mantissa * 2 ** -24 : sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
};
const HALVES = Float32Array.from({ length: 65536 }, (_, bits) => halfOf(bits));
const [LOG_LOW, LOG_HIGH] = data.pictures.log;
const LOGS = Float32Array.from({ length: 256 }, (_, code) =>
  (code === 0 ? 0 : 2 ** (LOG_LOW + (code * (LOG_HIGH - LOG_LOW)) / 255)));

const srgb = (v) => 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
const LIGHT_STEPS = 16384;
const CODES = Uint8ClampedArray.from({ length: LIGHT_STEPS + 1 }, (_, i) => srgb(i / LIGHT_STEPS));

const loaded = (uri) => new Promise((done, failed) => {
  const image = new Image();
  image.onload = () => done(image);
  image.onerror = () => failed(new Error("a picture in this file is damaged"));
  image.src = uri;
});

function bytesOf(image) {
  const canvas = make("canvas", { width: image.width, height: image.height });
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.drawImage(image, 0, 0);
  return pen.getImageData(0, 0, image.width, image.height).data;
}

/** High and low bytes as half floats, `count` for each pixel. */
function joined(high, low, count) {
  const bits = new Uint16Array((high.length / 4) * count);
  for (let from = 0, to = 0; from < high.length; from += 4)
    for (let c = 0; c < count; c++) bits[to++] = (high[from + c] << 8) | low[from + c];
  return bits;
}

/** High bytes as red and low ones as green: one half for each pixel. */
function joinedHere(bytes) {
  const bits = new Uint16Array(bytes.length / 4);
  for (let p = 0; p < bits.length; p++) bits[p] = (bytes[4 * p] << 8) | bytes[4 * p + 1];
  return bits;
}

/**
 * Colours of a part of the frame. `place` is where it lies in the picture that is shown; `values`
 * are what the codes mean. Each level has half the width and height of the one before it.
 */
function source(kind, place, width, height, codes, stride, more = {}) {
  return { kind, place, values: kind === "log" ? LOGS : HALVES, stride, levels: [{ width, height, codes }], ...more };
}

/** What is no number, or below 0, is kept: a mean would hide it. */
function smaller({ width, height, codes }, stride, isHalf) {
  const w = Math.ceil(width / 2), h = Math.ceil(height / 2);
  const to = isHalf ? new Uint16Array(w * h * stride) : new Uint8ClampedArray(w * h * stride);
  for (let y = 0; y < h; y++) {
    const top = 2 * y * width, below = Math.min(2 * y + 1, height - 1) * width;
    for (let x = 0; x < w; x++) {
      const left = 2 * x, right = Math.min(left + 1, width - 1);
      const places = [top + left, top + right, below + left, below + right];
      for (let c = 0; c < 3; c++) {
        let sum = 0, odd = -1;
        for (const place of places) {
          const code = codes[place * stride + c];
          sum += code;
          if (isHalf && code >= 0x7c00) odd = code;
        }
        to[(y * w + x) * stride + c] = odd < 0 ? (sum + 2) >> 2 : odd;
      }
    }
  }
  return { width: w, height: h, codes: to };
}

function levelOf(from, level) {
  while (from.levels.length <= level) {
    const last = from.levels[from.levels.length - 1];
    if (Math.min(last.width, last.height) < 2) break;
    from.levels.push(smaller(last, from.stride, from.kind === "half"));
  }
  return from.levels[Math.min(level, from.levels.length - 1)];
}

/** The display code of every code at an exposure. */
const tables = new Map();
function tableOf(values, stops) {
  const key = `${values.length} ${stops}`;
  if (!tables.has(key)) {
    if (tables.size > 20) tables.clear();
    const gain = 2 ** stops;
    tables.set(key, Uint8ClampedArray.from(values, (v) => CODES[lightStep(v * gain)]));
  }
  return tables.get(key);
}
const lightStep = (v) => (v > 0 ? (v < 1 ? Math.round(v * LIGHT_STEPS) : LIGHT_STEPS) : 0);

/** A part of a level as it is shown: all channels, or one of them as grey. */
function shownPart(from, level, x0, y0, width, height, look) {
  const picture = new ImageData(width, height);
  const to = picture.data;
  const { codes } = level;
  const { stride, values } = from;
  const table = tableOf(values, look.stops);
  const gain = 2 ** look.stops;
  const channel = "rgb".indexOf(look.channel);
  for (let y = 0, at = 0; y < height; y++) {
    let p = ((y0 + y) * level.width + x0) * stride;
    for (let x = 0; x < width; x++, p += stride, at += 4) {
      if (look.channel === "") {
        to[at] = table[codes[p]];
        to[at + 1] = table[codes[p + 1]];
        to[at + 2] = table[codes[p + 2]];
      } else {
        const grey = channel >= 0 ? table[codes[p + channel]]
          : CODES[lightStep(luminance(values[codes[p]], values[codes[p + 1]], values[codes[p + 2]]) * gain)];
        to[at] = to[at + 1] = to[at + 2] = grey;
      }
      to[at + 3] = 255;
    }
  }
  return picture;
}

const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** The colours of a map by its codes, from the picture of its legend. */
const ramps = {};
async function rampOf(kind) {
  ramps[kind] ??= bytesOf(await loaded(data.legends[kind]));
  return ramps[kind];
}

function coloured(bytes, ramp) {
  const steps = ramp.length / 4 - 1;
  const colours = new Uint8ClampedArray(bytes.length);
  for (let p = 0; p < bytes.length; p += 4) {
    const at = 4 * Math.round((bytes[p] / 255) * steps);
    colours[p] = ramp[at];
    colours[p + 1] = ramp[at + 1];
    colours[p + 2] = ramp[at + 2];
    colours[p + 3] = 255;
  }
  return colours;
}

function canvasOf(width, height, bytes) {
  const canvas = make("canvas", { width, height });
  canvas.getContext("2d").putImageData(new ImageData(bytes, width, height), 0, 0);
  return canvas;
}

/** A map: its codes, and a canvas of its colours. */
async function mapOf(uri, kind) {
  if (!uri) return null;
  const image = await loaded(uri);
  const bytes = bytesOf(image);
  const { width, height } = image;
  return { width, height, bytes, canvas: canvasOf(width, height, coloured(bytes, await rampOf(kind))) };
}

async function greyOf(uri) {
  if (!uri) return null;
  const image = await loaded(uri);
  const { width, height } = image;
  return { width, height, bytes: bytesOf(image), canvas: image };
}

async function logSource(uri, whole) {
  const image = await loaded(uri);
  return source("log", whole, image.width, image.height, bytesOf(image), 4);
}

async function halfSource(numbers, place, more) {
  const [high, low, alpha] = await Promise.all([numbers.high, numbers.low, numbers.alpha].map((uri) =>
    (uri ? loaded(uri) : null)));
  return source("half", place, high.width, high.height, joined(bytesOf(high), bytesOf(low), 3), 3, {
    alpha: alpha && joinedHere(bytesOf(alpha)), oneAlpha: numbers.one_alpha ?? null, ...more });
}

// ---- where a pixel of the file is shown

/** The Orientation of Exif: what is shown at the left and at the top. */
const TURNS = { 1: [1, 0, 0, 1], 2: [-1, 0, 0, 1], 3: [-1, 0, 0, -1], 4: [1, 0, 0, -1],
  5: [0, 1, 1, 0], 6: [0, -1, 1, 0], 7: [0, -1, -1, 0], 8: [0, 1, -1, 0] };

/** Corners of a rectangle of the file, moved into the picture that is shown. */
function shownPlace(full, { x, y, width, height }) {
  const [a, b, c, d] = TURNS[full.orientation] || TURNS[1];
  const turned = (px, py) => [
    a * px + b * py + (a < 0 ? full.width : 0) + (b < 0 ? full.height : 0),
    c * px + d * py + (c < 0 ? full.width : 0) + (d < 0 ? full.height : 0)];
  const [x0, y0] = turned(x - full.x, y - full.y);
  const [x1, y1] = turned(x - full.x + width, y - full.y + height);
  return { x: Math.min(x0, x1), y: Math.min(y0, y1), width: Math.abs(x1 - x0), height: Math.abs(y1 - y0) };
}

/** The pixel of the file that is shown there. */
function filePixel(full, x, y) {
  const [a, b, c, d] = TURNS[full.orientation] || TURNS[1];
  const px = x + 0.5 - ((a < 0 ? full.width : 0) + (b < 0 ? full.height : 0));
  const py = y + 0.5 - ((c < 0 ? full.width : 0) + (d < 0 ? full.height : 0));
  return [full.x + Math.floor(a * px + c * py), full.y + Math.floor(b * px + d * py)];
}

// ---- a frame

/** What a frame of the page holds, decoded; null where there is nothing. */
async function decoded(index) {
  const full = picturesOf(index, "full");
  const small = picturesOf(index, "small");
  const large = picturesOf(index, "large");
  if (!full || !(large || full.pictures)) return small ? thumbnailsOnly(await loaded(small.test), small) : null;
  const lies = full.orientation >= 5;
  const size = { x: 0, y: 0, width: lies ? full.height : full.width, height: lies ? full.width : full.height };
  const exact = picturesOf(index, "exact");
  const sides = {};
  for (const side of ["reference", "test"]) {
    const log = (large || full.pictures)[side];
    if (!log) continue;
    const more = (part) => ({ mean: part.columns !== part.width });
    const numbers = (part) => (part && part[side]
      ? halfSource(part[side], shownPlace(full, part), more(part)) : null);
    const [picture, near, all, alpha] = await Promise.all(
      [logSource(log, size), numbers(full.near), numbers(exact), greyOf(full.alpha[side])]);
    sides[side] = { picture, numbers: [near, all].filter(Boolean), alpha };
  }
  const [error, stops, bias, nearError] = await Promise.all([mapOf(full.error, "error"), mapOf(full.stops, "stops"),
    greyOf(full.bias), full.near && full.near.error ? loaded(full.near.error) : null]);
  return { index, full, size, sides, maps: { error, stops, bias }, start: full.start,
    reduced: !large && Math.max(full.width, full.height) > data.pictures.reduced,
    near: full.near && shownPlace(full, full.near),
    nearError: nearError && { place: shownPlace(full, full.near), width: nearError.width, bits: joinedHere(bytesOf(nearError)) } };
}

function thumbnailsOnly(image, small) {
  const known = frames.findIndex((_, i) => document.getElementById(`full-${i}`));
  const full = known >= 0 ? picturesOf(known, "full") : null;
  const lies = full && full.orientation >= 5;
  const width = full ? (lies ? full.height : full.width) : image.width;
  return { small, image, full: null, size: { x: 0, y: 0, width, height: (width * image.height) / image.width },
    sides: {}, maps: {}, start: 0 };
}

const decodedFrames = new Map();
/** The last few frames stay decoded. */
function frameOf(index) {
  if (!decodedFrames.has(index)) {
    if (decodedFrames.size > 3) decodedFrames.delete(decodedFrames.keys().next().value);
    decodedFrames.set(index, decoded(index));
  }
  return decodedFrames.get(index);
}

// ---- numbers

const inside = ({ x, y, width, height }, px, py) => px >= x && py >= y && px < x + width && py < y + height;

function codesAt(from, x, y) {
  const { width, height, codes } = from.levels[0];
  const { place } = from;
  const cx = Math.min(width - 1, Math.floor(((x + 0.5 - place.x) * width) / place.width));
  const cy = Math.min(height - 1, Math.floor(((y + 0.5 - place.y) * height) / place.height));
  const at = cy * width + cx;
  return { at, codes: [0, 1, 2].map((c) => codes[at * from.stride + c]) };
}

/** R, G, B, A of one side at a shown pixel, and what they are: "number", "mean" or "picture". */
function colourAt(side, x, y) {
  const exact = side.numbers.find((from) => inside(from.place, x, y));
  const from = exact || side.picture;
  const { at, codes } = codesAt(from, x, y);
  const rgb = codes.map((code) => from.values[code]);
  let alpha = null;
  if (exact && exact.alpha) alpha = HALVES[exact.alpha[at]];
  else if (exact && exact.oneAlpha !== null) alpha = exact.oneAlpha;
  else if (side.alpha) alpha = mapAt(side.alpha, x, y);
  else if (side.numbers.length) alpha = side.numbers[0].oneAlpha;
  return { rgb, alpha, how: !exact ? "picture" : exact.mean ? "mean" : "number" };
}

/** From 0 to 1. */
function mapAt(map, x, y, size = viewer.frame.size) {
  const cx = Math.min(map.width - 1, Math.floor(((x + 0.5) * map.width) / size.width));
  const cy = Math.min(map.height - 1, Math.floor(((y + 0.5) * map.height) / size.height));
  return map.bytes[4 * (cy * map.width + cx)] / 255;
}

/** The error of a shown pixel; `exact` where it is not read from the map. */
function errorAt(frame, x, y) {
  const near = frame.nearError;
  if (near && inside(near.place, x, y))
    return { value: HALVES[near.bits[(y - near.place.y) * near.width + (x - near.place.x)]], exact: true };
  return frame.maps.error ? { value: mapAt(frame.maps.error, x, y), exact: false } : null;
}
