// Files in one archive, stored as they are (zip, method 0), always with the same bytes for the same files.

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; k += 1) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n;
});

function crc(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = TABLE[(sum ^ byte) & 0xff] ^ (sum >>> 8);
  return (sum ^ 0xffffffff) >>> 0;
}

// A record of numbers: [size in bytes, value], little-endian, then bytes.
function record(numbers, ...rest) {
  const size = numbers.reduce((sum, [bytes]) => sum + bytes, 0);
  const view = new DataView(new ArrayBuffer(size));
  let at = 0;
  for (const [bytes, value] of numbers) {
    if (bytes === 4) view.setUint32(at, value, true);
    else view.setUint16(at, value, true);
    at += bytes;
  }
  return [new Uint8Array(view.buffer), ...rest];
}

// files: an object of texts by name.
export function zip(folder, files) {
  const [parts, index] = [[], []];
  let offset = 0;
  for (const [name, text] of Object.entries(files)) {
    const [path, data] = [`${folder}/${name}`, text].map((one) => new TextEncoder().encode(one));
    // Flag 0x800: names are UTF-8. Date: 1980-01-01.
    const common = [[2, 20], [2, 0x800], [2, 0], [2, 0], [2, 0x21], [4, crc(data)], [4, data.length], [4, data.length], [2, path.length], [2, 0]];
    const local = record([[4, 0x04034b50], ...common], path, data);
    index.push(record([[4, 0x02014b50], [2, 20], ...common, [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]], path));
    parts.push(...local);
    offset += local.reduce((sum, part) => sum + part.length, 0);
  }
  const central = index.flat();
  const size = central.reduce((sum, part) => sum + part.length, 0);
  const end = record([[4, 0x06054b50], [2, 0], [2, 0], [2, index.length], [2, index.length], [4, size], [4, offset], [2, 0]]);
  return new Blob([...parts, ...central, ...end], { type: "application/zip" });
}
