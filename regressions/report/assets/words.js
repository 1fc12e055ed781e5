/* Colours of a line of Verilog, Python or TOML: comments, texts and keywords. */

const KEYWORDS = {
  v:
    "module endmodule input output inout wire reg assign always begin end if else case endcase default " +
    "parameter localparam function endfunction generate endgenerate genvar for posedge negedge integer " +
    "signed initial",
  py: "def return lambda from import class for if else in not and or True False None",
  toml: "true false",
};
const COMMENTS = { v: String.raw`\/\/.*|\/\*.*?\*\/`, py: "#.*", toml: "#.*" };
const CLASSES = ["comment", "string", "word"];

/** What to look for in a file, by the end of its name: groups are the classes. */
function language(path) {
  const end = path.slice(path.lastIndexOf(".") + 1).replace("vh", "v");
  if (!Object.hasOwn(KEYWORDS, end)) return null;
  const words = KEYWORDS[end].replaceAll(" ", "|");
  return new RegExp(String.raw`(${COMMENTS[end]})|("(?:[^"\\]|\\.)*")|\b(${words})\b`, "g");
}

/** A line in pieces. */
function coloured(line, pattern) {
  if (!pattern) return line;
  const parts = [];
  let from = 0;
  for (const match of line.matchAll(pattern)) {
    const kind = CLASSES[match.slice(1).findIndex((found) => found !== undefined)];
    parts.push(line.slice(from, match.index), h("span", { class: kind }, match[0]));
    from = match.index + match[0].length;
  }
  return [...parts, line.slice(from)];
}
