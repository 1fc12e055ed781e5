/* The page's data, each section read when it is first needed. */

const known = new Map();

/** A section as it was written. */
function section(name) {
  if (!known.has(name)) known.set(name, JSON.parse(document.getElementById(`data-${name}`).textContent));
  return known.get(name);
}

/** A section's table as objects, each with its place as `index`. */
function rows(name) {
  const key = `rows ${name}`;
  if (!known.has(key)) {
    const { columns, rows: values } = section(name);
    known.set(
      key,
      values.map((row, index) =>
        Object.fromEntries([["index", index], ...columns.map((column, at) => [column, row[at]])]),
      ),
    );
  }
  return known.get(key);
}

/** Bins with their point and unit, full name, and whether they are a hole. */
function bins() {
  if (!known.has("bins")) {
    const units = rows("units");
    const points = rows("points").map((point) => ({ ...point, unit: units[point.unit] }));
    known.set(
      "bins",
      rows("bins").map((bin) => {
        const point = points[bin.point];
        const state = bin.excluded ? "excluded" : bin.hits ? "hit" : "hole";
        return {
          ...bin,
          point,
          unit: point.unit,
          state,
          full: `${point.unit.name}.${point.name}.${bin.name}`,
        };
      }),
    );
  }
  return known.get("bins");
}
