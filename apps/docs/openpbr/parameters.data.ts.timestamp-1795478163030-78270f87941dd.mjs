// openpbr/parameters.data.ts
import { defineLoader } from "file:///tmp/wt-me/node_modules/.pnpm/vitepress@1.6.4_@algolia+client-search@5.64.0_@types+node@20.19.43_@types+react@18.3.31_537527902d3afdea87a6bee698b64944/node_modules/vitepress/dist/node/index.js";

// src/parameter-rows.ts
var UNITS = {
  "1": "",
  length: " m",
  "cd/m\xB2": " cd/m\xB2",
  \u00B5m: " \xB5m"
};
var number = (value) => value === Infinity ? "\u221E" : value === -Infinity ? "\u2212\u221E" : String(value).replace("-", "\u2212");
var interval = (range) => range ? `${number(range[0])} \u2026 ${number(range[1])}` : "";
function initial(value) {
  if (value === null) return "none";
  if (typeof value === "boolean") return value ? "yes" : "no";
  return typeof value === "number" ? number(value) : value.map(number).join(", ");
}
function parameterRows(table, acting) {
  const groups = {};
  for (const { name, group, type, default: value, range, softRange, unit, texturable, doc } of Object.values(table)) {
    const soft = interval(softRange);
    (groups[group] ??= []).push({
      name,
      group,
      type,
      default: initial(value),
      range: interval(range),
      softRange: soft === interval(range) ? "" : soft,
      unit: range ? UNITS[unit] : "",
      texturable,
      acts: acting.includes(name),
      doc: doc.replaceAll("`", "")
    });
  }
  return groups;
}

// src/read-export.ts
import { fileURLToPath as fileURLToPath2 } from "node:url";
import { build } from "file:///tmp/wt-me/node_modules/.pnpm/esbuild@0.25.12/node_modules/esbuild/lib/main.js";

// ../../tools/pipeline/wesl.mjs
import { existsSync as existsSync2, readFileSync as readFileSync2 } from "node:fs";
import { dirname, join as join2, relative as relative2, resolve, sep } from "node:path";

// ../../tools/pipeline/wesl-constants.mjs
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { fileURLToPath } from "node:url";

// ../../tools/pipeline/wesl-tokens.mjs
var WeslError = class extends Error {
  name = "WeslError";
};
var TOKEN = /\/\/[^\n]*|\/\*|[A-Za-z_]\w*|(?:\d|\.\d)(?:[eEpP][-+]|[\w.])*|::|&&|\|\||\S/g;
function tokenize(text, fail) {
  const tokens = [];
  const comments = [];
  TOKEN.lastIndex = 0;
  for (let match; match = TOKEN.exec(text); ) {
    const from = match.index;
    if (match[0] === "/*") {
      let depth = 0;
      const edge = /\/\*|\*\//g;
      edge.lastIndex = from;
      for (let found; found = edge.exec(text); ) {
        depth += found[0] === "/*" ? 1 : -1;
        if (depth === 0) break;
      }
      if (depth !== 0) fail(from, "a block comment never ends");
      comments.push({ from, to: edge.lastIndex });
      TOKEN.lastIndex = edge.lastIndex;
    } else if (match[0].startsWith("//")) comments.push({ from, to: TOKEN.lastIndex });
    else tokens.push({ text: match[0], from, to: TOKEN.lastIndex });
  }
  return { tokens, comments };
}

// ../../tools/pipeline/wesl-constants.mjs
var __vite_injected_original_dirname = "/tmp/wt-me/tools/pipeline";
var __vite_injected_original_import_meta_url = "file:///tmp/wt-me/tools/pipeline/wesl-constants.mjs";
var SCALAR = /^(?:i32|u32|f32|f16|bool)$/;
var VECTOR = /^vec([234])([iufh]?)$/;
var NUMBER = /^(?:0[xX][\da-fA-F]+[iu]?|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[iufh]?)$/;
function numberOf(text) {
  const hex = /^0[xX]/.test(text);
  return Number(text.replace(hex ? /[iu]$/ : /[iufh]$/, ""));
}
function readConstants(text, file = "constants.wesl") {
  const lineOf = (at) => text.slice(0, at).split("\n").length;
  const fail = (at, message) => {
    throw new WeslError(`${file}:${lineOf(at)}: ${message}.`);
  };
  const { tokens, comments } = tokenize(text, fail);
  const demanded = /(^|[\\/])constants\.wesl$/.test(file);
  if (!demanded && !holdsOnlyConstants(tokens)) return void 0;
  let next = 0;
  const peek = () => tokens[next]?.text;
  const here = () => tokens[next]?.from ?? text.length;
  const take = (expected) => {
    const token = tokens[next];
    if (token === void 0 || expected !== void 0 && token.text !== expected)
      return fail(here(), `"${token?.text ?? "the end"}" stands where "${expected ?? "more"}" is expected`);
    next++;
    return token;
  };
  const type = () => {
    const at = here();
    const name = take().text;
    if (SCALAR.test(name)) return { kind: "scalar", scalar: name };
    const vector = VECTOR.exec(name);
    if (vector) {
      let scalar = { i: "i32", u: "u32", f: "f32", h: "f16" }[vector[2]];
      if (scalar === void 0 && peek() === "<") {
        take("<");
        const inner = type();
        if (inner.kind !== "scalar") fail(at, "a vector holds numbers");
        scalar = inner.scalar;
        take(">");
      }
      return { kind: "vector", count: Number(vector[1]), scalar };
    }
    if (name === "array") {
      if (peek() !== "<") return { kind: "array" };
      take("<");
      const element = type();
      let count;
      if (peek() === ",") {
        take(",");
        const length = take();
        if (!/^\d+u?$/.test(length.text)) fail(length.from, "the length of an array is a literal");
        count = numberOf(length.text);
        if (peek() === ",") take(",");
      }
      take(">");
      return { kind: "array", element, count };
    }
    return fail(at, `"${name}" is no number, boolean, vector or array: a table of constants holds literals`);
  };
  const check = (at, value, written, scalar) => {
    const suffix = /^0[xX]/.test(written) ? /[iu]$/.exec(written)?.[0] : /[iufh]$/.exec(written)?.[0];
    const own = { i: "i32", u: "u32", f: "f32", h: "f16" }[suffix];
    const is = own ?? scalar;
    if (own !== void 0 && scalar !== void 0 && own !== scalar) fail(at, `${written} is no ${scalar}`);
    if ((is === "i32" || is === "u32") && !Number.isInteger(value)) fail(at, `${written} is no ${is}`);
    if (is === "bool") fail(at, `${written} is no bool`);
    const [low, high] = is === "u32" ? [0, 2 ** 32 - 1] : is === "i32" ? [-(2 ** 31), 2 ** 31 - 1] : [-34028235e31, 34028235e31];
    if (value < low || value > high) fail(at, `${written} is out of range`);
  };
  const expression = (wanted) => {
    const at = here();
    const token = peek();
    if (token === "true" || token === "false") {
      if (wanted !== void 0 && wanted.scalar !== "bool") fail(at, `${token} stands where a number is expected`);
      take();
      return { value: token === "true", type: "boolean" };
    }
    if (token === "-" || NUMBER.test(token ?? "")) {
      if (wanted !== void 0 && wanted.kind !== "scalar") fail(at, "a number stands where several are expected");
      if (token === "-") take();
      const { text: written, from } = take();
      if (!NUMBER.test(written)) fail(from, `"${written}" is no literal`);
      const value = token === "-" ? -numberOf(written) : numberOf(written);
      check(from, value, written, wanted?.scalar);
      return { value, type: "number" };
    }
    const found = type();
    if (found.kind === "scalar") fail(at, "a table of constants converts no values: write the literal");
    if (wanted !== void 0 && wanted.kind !== found.kind) fail(at, "the value is of another type");
    take("(");
    const of = found.kind === "vector" ? { kind: "scalar", scalar: found.scalar } : found.element;
    const elements = [];
    while (peek() !== ")") {
      elements.push(expression(of));
      if (peek() !== ")") take(",");
    }
    take(")");
    const count = found.count ?? (wanted?.kind === "array" ? wanted.count : void 0) ?? elements.length;
    if (elements.length === 0 || elements.length !== count)
      fail(at, `${elements.length} values stand where ${count || "some"} are expected`);
    const element = elements[0].type;
    if (elements.some(({ type: other }) => other !== element)) fail(at, "the elements are of several types");
    return {
      value: elements.map(({ value }) => value),
      type: found.kind === "vector" ? `readonly [${elements.map(() => element).join(", ")}]` : `readonly ${/^\w+$/.test(element) ? element : `(${element})`}[]`
    };
  };
  const constants = [];
  while (next < tokens.length) {
    const at = here();
    if (peek() !== "const")
      fail(at, `"${peek()}" stands in a table of constants, which holds "const NAME = literal;" alone`);
    take();
    const name = take();
    if (constants.some((other) => other.name === name.text)) fail(name.from, `${name.text} is declared twice`);
    let declared;
    if (peek() === ":") {
      take();
      declared = type();
    }
    take("=");
    const found = expression(declared);
    if (peek() !== ";") fail(here(), `"${peek() ?? "the end"}" follows the literal: write the value itself`);
    take(";");
    constants.push({ name: name.text, ...found, doc: commentBefore(text, comments, at), line: lineOf(at) });
  }
  if (constants.length === 0) fail(0, "it holds no constant");
  return constants;
}
function holdsOnlyConstants(tokens) {
  if (tokens.length === 0) return false;
  let begins = true;
  for (const { text } of tokens) {
    if (begins && text !== "const") return false;
    begins = text === ";";
  }
  return true;
}
function commentBefore(text, comments, at) {
  const lines = [];
  let below = text.lastIndexOf("\n", at - 1) + 1;
  for (const { from, to } of [...comments].reverse()) {
    if (from >= at) continue;
    const begin = text.lastIndexOf("\n", from - 1) + 1;
    if (to + 1 !== below || text.slice(begin, from).trim() !== "" || !text.startsWith("//", from)) break;
    lines.unshift(text.slice(from + 2, to).trim());
    below = begin;
  }
  return lines.join("\n");
}
var exportedConstants = (constants) => `export const ${constants.map(({ name, value }) => `${name} = ${JSON.stringify(value)}`).join(", ")};
`;
function declareConstants(text, file) {
  const lines = ["import type { WgslModule } from '@glanz/wgsl';", ""];
  for (const { name, type, doc } of readConstants(text, file)) {
    const docs = doc.split("\n");
    if (doc !== "" && docs.length === 1) lines.push(`/** ${doc} */`);
    else if (doc !== "") lines.push("/**", ...docs.map((line) => ` * ${line}`.trimEnd()), " */");
    lines.push(`export const ${name}: ${type};`);
  }
  return `${lines.join("\n")}

declare const module: WgslModule;
export default module;
`;
}
var declarationFile = (file) => `${file}.d.ts`;
function constantFiles(root) {
  return readdirSync(join(root, "packages")).map((name) => join(root, "packages", name, "src")).filter((folder) => existsSync(folder)).flatMap((folder) => readdirSync(folder, { recursive: true, encoding: "utf8" }).map((path) => join(folder, path))).filter((file) => file.endsWith(".wesl") && readConstants(readFileSync(file, "utf8"), file) !== void 0).sort();
}
if (process.argv[1] === fileURLToPath(__vite_injected_original_import_meta_url)) {
  const root = join(__vite_injected_original_dirname, "../..");
  for (const file of constantFiles(root)) {
    writeFileSync(declarationFile(file), declareConstants(readFileSync(file, "utf8"), file));
    process.stdout.write(`${relative(root, declarationFile(file))}
`);
  }
}

// ../../tools/pipeline/wesl-names.mjs
var KEYWORDS = /* @__PURE__ */ new Set(["_", "do", "fn", "if", "as", "is", "of"]);
function* shortNames() {
  const letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  for (const letter of letters) yield letter;
  for (const first of letters) for (const second of letters) yield first + second;
}
function shortenLocals(tokens) {
  const edits = [];
  const identifiers = new Set(tokens.map(({ text: text2 }) => text2));
  const text = (i2) => tokens[i2]?.text;
  let i = 0;
  const afterBracket = (at) => {
    let depth = 0;
    do {
      if ("([{".includes(text(at))) depth++;
      if (")]}".includes(text(at))) depth--;
      at++;
    } while (depth > 0 && at < tokens.length);
    return at;
  };
  const functionAt = () => {
    const names = /* @__PURE__ */ new Map();
    const candidates = shortNames();
    const shortFor = (name) => {
      let short = names.get(name);
      while (short === void 0) {
        const { value } = candidates.next();
        if (value === void 0) short = name;
        else if (!identifiers.has(value) && !KEYWORDS.has(value)) short = value;
      }
      names.set(name, short);
      return short;
    };
    const scopes = [/* @__PURE__ */ new Set()];
    const declare = (name) => scopes.at(-1).add(name);
    const replace = (at) => {
      const { text: name, from, to } = tokens[at];
      const short = shortFor(name);
      if (short.length < name.length) edits.push({ from, to, text: short });
    };
    const skipAttribute = () => {
      i += 2;
      if (text(i) === "(") i = afterBracket(i);
    };
    i += 2;
    for (let depth2 = 0; ; ) {
      const token = text(i);
      if (token === "@") {
        skipAttribute();
        continue;
      }
      if (token === "(" || token === "<") depth2++;
      if (token === ")" || token === ">") depth2--;
      if (depth2 === 1 && text(i + 1) === ":" && /^[A-Za-z_]/.test(token)) {
        declare(token);
        replace(i);
      }
      i++;
      if (depth2 === 0) break;
    }
    while (text(i) !== "{") i += 1;
    let pending = [];
    const heads = [];
    let round = 0;
    const settle = () => {
      pending.forEach(declare);
      pending = [];
    };
    let depth = 0;
    do {
      const token = text(i);
      if (token === "@") {
        skipAttribute();
        continue;
      }
      if (token === "for") {
        scopes.push(/* @__PURE__ */ new Set());
        heads.push({ depth, round });
      } else if (token === "(") round++;
      else if (token === ")") round--;
      else if (token === ";") settle();
      else if (token === "{") {
        settle();
        depth++;
        scopes.push(/* @__PURE__ */ new Set());
      } else if (token === "}") {
        settle();
        depth--;
        scopes.pop();
        if (heads.at(-1)?.depth === depth && heads.at(-1).round === round) {
          heads.pop();
          scopes.pop();
        }
      } else if (/^(let|var|const)$/.test(token)) {
        let at = i + 1;
        if (text(at) === "<") while (text(at++) !== ">") ;
        pending.push(text(at));
        replace(at);
        i = at;
      } else if (/^[A-Za-z_]/.test(token) && text(i - 1) !== "." && scopes.some((scope) => scope.has(token)))
        replace(i);
      i++;
    } while (depth > 0);
  };
  while (i < tokens.length) {
    if (text(i) === "fn") functionAt();
    else i++;
  }
  return edits;
}

// ../../tools/pipeline/wesl.mjs
var CLOSING = { "(": ")", "[": "]", "{": "}", "<": ">" };
function parseWesl(text, file = "module.wesl") {
  const fail = (at, message) => {
    throw new WeslError(`${file}:${text.slice(0, at).split("\n").length}: ${message}.`);
  };
  const { tokens, comments } = tokenize(text, fail);
  const imports = [];
  const edits = [];
  let next = 0;
  const peek = () => tokens[next]?.text;
  const here = () => tokens[next]?.from ?? text.length;
  const take = (expected) => {
    const token = tokens[next];
    if (!token) return fail(text.length, expected ? `"${expected}" is missing at the end` : "the file ends too soon");
    if (expected !== void 0 && token.text !== expected)
      fail(token.from, `"${token.text}" stands where "${expected}" is expected`);
    next++;
    return token;
  };
  const endOfLast = () => tokens[next - 1].to;
  const skipBracket = () => {
    const open = take();
    for (const close = CLOSING[open.text]; peek() !== close; ) skipToken();
    take();
  };
  const skipToken = () => {
    if (peek() === void 0) fail(text.length, "the file ends inside of a bracket");
    if (peek() === "@" && /^(if|elif|else)$/.test(tokens[next + 1]?.text ?? ""))
      fail(
        here(),
        `@${tokens[next + 1].text} stands where no declaration, member, parameter, statement or import begins`
      );
    if (peek() in CLOSING && peek() !== "<") skipBracket();
    else take();
  };
  const skipTo = (...ends) => {
    while (!ends.includes(peek())) skipToken();
  };
  const condition = () => {
    const from = take("(").from;
    const parts = [];
    do {
      if (parts.length > 0) take("&&");
      let negated = false;
      while (peek() === "!") {
        take();
        negated = !negated;
      }
      const flag = take();
      if (!/^[A-Za-z_]\w*$/.test(flag.text))
        fail(
          flag.from,
          "a condition is a flag, !flag, or several of them with && between; for || use a flag that stands for both"
        );
      parts.push(`${negated ? "!" : ""}${flag.text}`);
    } while (peek() === "&&");
    if (peek() !== ")")
      fail(
        from,
        "a condition is a flag, !flag, or several of them with && between; for || use a flag that stands for both"
      );
    take(")");
    return parts.join("&&");
  };
  const attributes = () => {
    let gate;
    while (peek() === "@") {
      const { from } = take("@");
      const name = take();
      if (/^(if|elif|else)$/.test(name.text)) {
        if (gate) fail(from, "an element has two conditions: join them by &&");
        gate = { kind: name.text, from, condition: name.text === "else" ? void 0 : condition(), to: 0 };
        gate.to = endOfLast();
      } else if (peek() === "(") skipBracket();
    }
    return gate;
  };
  const importTree = (path) => {
    const found = [];
    const branch = (before) => {
      if (peek() === "{") {
        take("{");
        while (peek() !== "}") {
          branch(before);
          if (peek() !== "}") take(",");
        }
        take("}");
        return;
      }
      const name = take();
      if (!/^[A-Za-z_]\w*$/.test(name.text)) fail(name.from, `"${name.text}" is no name to import`);
      if (peek() === "::") {
        take("::");
        branch([...before, name.text]);
      } else if (peek() === "as") fail(here(), "imports cannot be renamed: names are unique in all of the project");
      else found.push({ path: before, name: name.text, at: name.from });
    };
    branch(path);
    return found;
  };
  const importStatement = (from, gate) => {
    if (gate && (gate.kind !== "if" || gate.condition.includes("&")))
      fail(from, "an import is gated by @if(FLAG) or @if(!FLAG)");
    take("import");
    for (const { path, name, at } of importTree([])) {
      if (path.length === 0) fail(at, `"import ${name}" names no module`);
      imports.push({ path, name, flag: gate?.condition, line: text.slice(0, at).split("\n").length });
    }
    take(";");
    edits.push({ from, to: endOfLast(), text: text.slice(from, endOfLast()).replace(/[^\n]+/g, "") });
  };
  const block = () => {
    take("{");
    sequence(statement, "}");
    take("}");
  };
  const declaration = () => {
    if (peek() === "fn") {
      take();
      take();
      take("(");
      sequence(listed(")"), ")");
      take(")");
      skipTo("{");
      block();
    } else if (peek() === "struct") {
      take();
      take();
      take("{");
      sequence(listed("}"), "}");
      take("}");
      if (peek() === ";") take();
    } else {
      if (peek() !== ";") skipTo(";");
      take(";");
    }
  };
  const listed = (close) => () => {
    let depth = 0;
    while (depth > 0 || peek() !== "," && peek() !== close) {
      if (peek() === "<") depth++;
      if (peek() === ">") depth--;
      skipToken();
    }
    if (peek() === ",") take();
  };
  const clause = () => {
    if (peek() !== "case" && peek() !== "default") fail(here(), `"${peek()}" stands where a case is expected`);
    skipTo("{");
    block();
  };
  const statement = () => {
    switch (peek()) {
      case "{":
        return block();
      case "if":
      case "for":
      case "while":
        take();
        skipTo("{");
        block();
        while (peek() === "else") {
          take();
          skipTo("{");
          block();
        }
        return void 0;
      case "loop":
      case "continuing":
        take();
        skipTo("{");
        return block();
      case "switch":
        take();
        skipTo("{");
        take("{");
        sequence(clause, "}");
        take("}");
        return void 0;
      default:
        skipTo(";", "}");
        take(";");
        return void 0;
    }
  };
  const sequence = (element, close) => {
    let open = 0;
    let end = 0;
    let alone;
    const closeChain = () => {
      if (open > 0)
        edits.push({ from: end, to: end, text: `${"//#endif".repeat(open)}${/\w/.test(text[end] ?? "") ? " " : ""}` });
      open = 0;
      alone = void 0;
    };
    while (peek() !== close) {
      if (peek() === void 0) fail(text.length, `"${close}" is missing at the end`);
      const from = here();
      const gate = attributes();
      const shared = gate?.kind === "if" && gate.condition === alone && peek() !== "import";
      if ((!gate || gate.kind === "if") && !shared) closeChain();
      if (peek() === "import" && close === void 0) {
        importStatement(from, gate);
        continue;
      }
      if (gate) {
        if (gate.kind !== "if" && open === 0) fail(gate.from, `@${gate.kind} without @if before it`);
        const start = gate.kind === "if" ? "" : "//#else";
        const gap = /\s/.test(text[gate.to] ?? " ") ? "" : " ";
        const marks = shared ? "" : `${start}${gate.condition === void 0 ? "" : `//#if ${gate.condition}`}`;
        edits.push({ from: gate.from, to: gate.to, text: `${marks}${gap}` });
        if (gate.condition !== void 0 && !shared) open++;
        alone = gate.kind === "if" ? gate.condition : void 0;
      }
      element();
      end = endOfLast();
      if (gate?.kind === "else") closeChain();
    }
    closeChain();
  };
  sequence(declaration, void 0);
  for (const { from, to } of comments)
    if (text.slice(from, to).includes("//#")) fail(from, 'a comment must not hold "//#", which marks gates');
  return { imports, edits, comments, tokens };
}
var OPERATOR = /[-+*/%=<>!&|^~]/;
function closeUp(line) {
  if (line.includes("//")) return line;
  const closed = line.replace(/(?<=(\S)) +(?=(\S))/g, (spaces, before, after) => {
    const separates = /\w/.test(before) && /\w/.test(after);
    return separates || OPERATOR.test(before) && OPERATOR.test(after) ? spaces : "";
  });
  return closed.replace(/(?<=\d\.)0(?=[^\w.])/g, "").replace(/(?<![\w.])0(?=\.\d)/g, "");
}
var closeUpGated = (line) => line.split(/(\/\/#(?:if [\w!&]+|else|endif))/).map((part, i) => {
  if (i % 2) return part;
  const shut = closeUp(part.trim());
  return i > 0 && /^\w/.test(shut) ? ` ${shut}` : shut;
}).join("");
function apply(text, edits) {
  let result = text;
  for (const edit of [...edits].sort((a, b) => b.from - a.from || b.to - a.to))
    result = result.slice(0, edit.from) + edit.text + result.slice(edit.to);
  return result;
}
function gatedText(text, { edits, comments, tokens }, shrink) {
  if (!shrink) return apply(text, edits);
  const bare = apply(text, [
    ...edits,
    ...shortenLocals(tokens),
    ...comments.map(({ from, to }) => ({ from, to, text: text.slice(from, to).replace(/[^\n]+/g, "") || " " }))
  ]);
  return bare.split("\n").map(closeUpGated).join("\n");
}
function packageOf(file) {
  for (let folder = dirname(file); folder !== dirname(folder); folder = dirname(folder)) {
    const manifest = join2(folder, "package.json");
    if (existsSync2(manifest))
      return { folder, short: JSON.parse(readFileSync2(manifest, "utf8")).name.split("/").at(-1) };
  }
  throw new WeslError(`${file}: it lies in no package.`);
}
var isNumber = (name) => /^[A-Z][A-Z\d]*(?:_[A-Z\d]+)*$/.test(name);
var isHost = (path) => path.at(-1) === "host";
function resolveModule({ path, name, line }, file, source) {
  const [root, ...rest] = path;
  const folder = root === "package" ? source : root === "super" ? dirname(file) : void 0;
  if (folder === void 0) throw new WeslError(`${file}:${line}: "${root}" is no root of a path: package or super.`);
  const base = resolve(folder, ...rest);
  if (existsSync2(`${base}.wesl`)) return { file: `${base}.wesl`, wesl: true };
  const typescript = `${join2(dirname(base), (rest.at(-1) ?? "").replaceAll("_", "-"))}.ts`;
  if (existsSync2(typescript)) return { file: typescript, wesl: false };
  throw new WeslError(
    `${file}:${line}: there is no module ${path.join("::")} to import ${name} from: neither ${base}.wesl nor ${typescript}.`
  );
}
function compileWesl(text, file, { shrink = false, page = false } = {}) {
  const parsed = parseWesl(text, file);
  const { folder, short } = packageOf(file);
  const source = join2(folder, "src");
  const names = /* @__PURE__ */ new Map();
  const dependencies = /* @__PURE__ */ new Map();
  const numbers = /* @__PURE__ */ new Map();
  const used = /* @__PURE__ */ new Set(["wgslModule"]);
  let imports = "";
  for (const entry of parsed.imports) {
    if (isHost(entry.path)) continue;
    const { file: target, wesl } = resolveModule(entry, file, source);
    const specifier = `./${relative2(dirname(file), target).split(sep).join("/")}`.replace(/^\.\/\.\.\//, "../").replace(/\.ts$/, "");
    if (!wesl && isNumber(entry.name)) {
      if (numbers.has(entry.name)) continue;
      numbers.set(entry.name, `number${numbers.size}`);
      imports += `import { ${entry.name} as ${numbers.get(entry.name)} } from ${JSON.stringify(specifier)};`;
      continue;
    }
    const key = wesl ? specifier : `${specifier} ${entry.name}`;
    let name = names.get(key);
    if (name === void 0) {
      names.set(key, name = `module${names.size}`);
      imports += `import ${wesl ? name : `{ ${entry.name} as ${name} }`} from ${JSON.stringify(specifier)};`;
    }
    if (entry.flag !== void 0) used.add("gated");
    const dependency = entry.flag === void 0 ? name : `/* @__PURE__ */ gated(${JSON.stringify(entry.flag)}, ${name})`;
    dependencies.set(dependency, dependency);
  }
  const title = `${short}/${file.split(/[\\/]/).at(-1).replace(/\.wesl$/, "").replaceAll("_", "-")}`;
  const lines = gatedText(text, parsed, shrink || page);
  const template = (page ? lines.replace(/\n\n+/g, "\n").trimStart() : lines).replace(/[\\`]|\$(?=\{)/g, "\\$&").replace(/[A-Za-z_]\w*/g, (name) => numbers.has(name) ? `\${${numbers.get(name)}}u` : name);
  const code = `import { ${[...used].sort().join(", ")} } from "@glanz/wgsl/module";${imports}export default /* @__PURE__ */ wgslModule(${JSON.stringify(title)}, \`${template}\`${dependencies.size > 0 ? `, [${[...dependencies.values()].join(", ")}]` : ""});
`;
  const constants = readConstants(text, file);
  const mappings = `AAAA${";AACA".repeat(text.split("\n").length - 1)}`;
  return {
    code: constants ? code + exportedConstants(constants) : code,
    map: { version: 3, sources: [file.split(/[\\/]/).at(-1)], sourcesContent: [text], names: [], mappings }
  };
}
var weslSource = (options = {}) => ({
  name: "wesl",
  setup(build2) {
    build2.onLoad({ filter: /\.wesl$/ }, ({ path }) => {
      const { code, map } = compileWesl(readFileSync2(path, "utf8"), path, options);
      return {
        contents: `${code}//# sourceMappingURL=data:application/json;base64,${Buffer.from(JSON.stringify(map)).toString("base64")}`,
        loader: "js",
        resolveDir: dirname(path)
      };
    });
  }
});

// src/read-export.ts
var __vite_injected_original_import_meta_url2 = "file:///tmp/wt-me/apps/docs/src/read-export.ts";
async function readExport(specifier, name) {
  const { outputFiles } = await build({
    stdin: {
      contents: `export { ${name} as value } from '${specifier}';`,
      resolveDir: fileURLToPath2(new URL(".", __vite_injected_original_import_meta_url2))
    },
    conditions: ["@glanz/source"],
    bundle: true,
    format: "esm",
    platform: "neutral",
    plugins: [weslSource()],
    write: false
  });
  const { value } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
  return value;
}

// openpbr/parameters.data.ts
var parameters_data_default = defineLoader({
  watch: ["../../../packages/openpbr/src/{parameters,wgsl}/*.ts"],
  async load() {
    const table = await readExport("@glanz/openpbr/parameters", "OPENPBR_PARAMETERS");
    const acting = await readExport("./acting", "actingParameters");
    return parameterRows(table, acting());
  }
});
export {
  parameters_data_default as default
};
//# sourceMappingURL=data:application/json;base64,ewogICJ2ZXJzaW9uIjogMywKICAic291cmNlcyI6IFsib3BlbnBici9wYXJhbWV0ZXJzLmRhdGEudHMiLCAic3JjL3BhcmFtZXRlci1yb3dzLnRzIiwgInNyYy9yZWFkLWV4cG9ydC50cyIsICIuLi8uLi90b29scy9waXBlbGluZS93ZXNsLm1qcyIsICIuLi8uLi90b29scy9waXBlbGluZS93ZXNsLWNvbnN0YW50cy5tanMiLCAiLi4vLi4vdG9vbHMvcGlwZWxpbmUvd2VzbC10b2tlbnMubWpzIiwgIi4uLy4uL3Rvb2xzL3BpcGVsaW5lL3dlc2wtbmFtZXMubWpzIl0sCiAgInNvdXJjZXNDb250ZW50IjogWyJjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZGlybmFtZSA9IFwiL3RtcC93dC1tZS9hcHBzL2RvY3Mvb3BlbnBiclwiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS9hcHBzL2RvY3Mvb3BlbnBici9wYXJhbWV0ZXJzLmRhdGEudHNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfaW1wb3J0X21ldGFfdXJsID0gXCJmaWxlOi8vL3RtcC93dC1tZS9hcHBzL2RvY3Mvb3BlbnBici9wYXJhbWV0ZXJzLmRhdGEudHNcIjsvLyBUaGUgcGFyYW1ldGVyIHRhYmxlIG91dCBvZiB0aGUgc291cmNlcyBvZiBAZ2xhbnovb3BlbnBicjsgbm8gY29weSBvZiBpdCBsaWVzIGhlcmUuXG5pbXBvcnQgdHlwZSB7IE9wZW5QYnJQYXJhbWV0ZXJJbmZvIH0gZnJvbSAnQGdsYW56L29wZW5wYnIvcGFyYW1ldGVycyc7XG5pbXBvcnQgeyBkZWZpbmVMb2FkZXIgfSBmcm9tICd2aXRlcHJlc3MnO1xuaW1wb3J0IHsgcGFyYW1ldGVyUm93cyB9IGZyb20gJy4uL3NyYy9wYXJhbWV0ZXItcm93cyc7XG5pbXBvcnQgeyByZWFkRXhwb3J0IH0gZnJvbSAnLi4vc3JjL3JlYWQtZXhwb3J0JztcblxudHlwZSBSb3dzID0gUmV0dXJuVHlwZTx0eXBlb2YgcGFyYW1ldGVyUm93cz47XG5cbmRlY2xhcmUgY29uc3QgZGF0YTogUm93cztcbmV4cG9ydCB7IGRhdGEgfTtcblxuZXhwb3J0IGRlZmF1bHQgZGVmaW5lTG9hZGVyKHtcbiAgd2F0Y2g6IFsnLi4vLi4vLi4vcGFja2FnZXMvb3BlbnBici9zcmMve3BhcmFtZXRlcnMsd2dzbH0vKi50cyddLFxuICBhc3luYyBsb2FkKCk6IFByb21pc2U8Um93cz4ge1xuICAgIGNvbnN0IHRhYmxlID0gKGF3YWl0IHJlYWRFeHBvcnQoJ0BnbGFuei9vcGVucGJyL3BhcmFtZXRlcnMnLCAnT1BFTlBCUl9QQVJBTUVURVJTJykpIGFzIFJlY29yZDxcbiAgICAgIHN0cmluZyxcbiAgICAgIE9wZW5QYnJQYXJhbWV0ZXJJbmZvXG4gICAgPjtcbiAgICBjb25zdCBhY3RpbmcgPSAoYXdhaXQgcmVhZEV4cG9ydCgnLi9hY3RpbmcnLCAnYWN0aW5nUGFyYW1ldGVycycpKSBhcyAoKSA9PiBzdHJpbmdbXTtcbiAgICByZXR1cm4gcGFyYW1ldGVyUm93cyh0YWJsZSwgYWN0aW5nKCkpO1xuICB9LFxufSk7XG4iLCAiY29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2Rpcm5hbWUgPSBcIi90bXAvd3QtbWUvYXBwcy9kb2NzL3NyY1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS9hcHBzL2RvY3Mvc3JjL3BhcmFtZXRlci1yb3dzLnRzXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCA9IFwiZmlsZTovLy90bXAvd3QtbWUvYXBwcy9kb2NzL3NyYy9wYXJhbWV0ZXItcm93cy50c1wiO2ltcG9ydCB0eXBlIHsgT3BlblBickdyb3VwLCBPcGVuUGJyUGFyYW1ldGVySW5mbyB9IGZyb20gJ0BnbGFuei9vcGVucGJyL3BhcmFtZXRlcnMnO1xuXG4vKiogT25lIGxpbmUgb2YgdGhlIHBhcmFtZXRlciB0YWJsZXMsIHJlYWR5IHRvIHByaW50LiAqL1xuZXhwb3J0IGludGVyZmFjZSBQYXJhbWV0ZXJSb3cge1xuICByZWFkb25seSBuYW1lOiBzdHJpbmc7XG4gIHJlYWRvbmx5IGdyb3VwOiBPcGVuUGJyR3JvdXA7XG4gIHJlYWRvbmx5IHR5cGU6IHN0cmluZztcbiAgcmVhZG9ubHkgZGVmYXVsdDogc3RyaW5nO1xuICByZWFkb25seSByYW5nZTogc3RyaW5nO1xuICByZWFkb25seSBzb2Z0UmFuZ2U6IHN0cmluZztcbiAgcmVhZG9ubHkgdW5pdDogc3RyaW5nO1xuICByZWFkb25seSB0ZXh0dXJhYmxlOiBib29sZWFuO1xuICAvKiogV2hldGhlciB0aGUgcmVuZGVyZXIgcmVhZHMgaXQgeWV0LiAqL1xuICByZWFkb25seSBhY3RzOiBib29sZWFuO1xuICByZWFkb25seSBkb2M6IHN0cmluZztcbn1cblxuY29uc3QgVU5JVFM6IFJlYWRvbmx5PFJlY29yZDxPcGVuUGJyUGFyYW1ldGVySW5mb1sndW5pdCddLCBzdHJpbmc+PiA9IHtcbiAgJzEnOiAnJyxcbiAgbGVuZ3RoOiAnIG0nLFxuICAnY2QvbVx1MDBCMic6ICcgY2QvbVx1MDBCMicsXG4gIFx1MDBCNW06ICcgXHUwMEI1bScsXG59O1xuXG5jb25zdCBudW1iZXIgPSAodmFsdWU6IG51bWJlcikgPT5cbiAgdmFsdWUgPT09IEluZmluaXR5ID8gJ1x1MjIxRScgOiB2YWx1ZSA9PT0gLUluZmluaXR5ID8gJ1x1MjIxMlx1MjIxRScgOiBTdHJpbmcodmFsdWUpLnJlcGxhY2UoJy0nLCAnXHUyMjEyJyk7XG5jb25zdCBpbnRlcnZhbCA9IChyYW5nZTogcmVhZG9ubHkgW251bWJlciwgbnVtYmVyXSB8IHVuZGVmaW5lZCkgPT5cbiAgcmFuZ2UgPyBgJHtudW1iZXIocmFuZ2VbMF0pfSBcdTIwMjYgJHtudW1iZXIocmFuZ2VbMV0pfWAgOiAnJztcblxuZnVuY3Rpb24gaW5pdGlhbCh2YWx1ZTogT3BlblBiclBhcmFtZXRlckluZm9bJ2RlZmF1bHQnXSk6IHN0cmluZyB7XG4gIGlmICh2YWx1ZSA9PT0gbnVsbCkgcmV0dXJuICdub25lJztcbiAgaWYgKHR5cGVvZiB2YWx1ZSA9PT0gJ2Jvb2xlYW4nKSByZXR1cm4gdmFsdWUgPyAneWVzJyA6ICdubyc7XG4gIHJldHVybiB0eXBlb2YgdmFsdWUgPT09ICdudW1iZXInID8gbnVtYmVyKHZhbHVlKSA6IHZhbHVlLm1hcChudW1iZXIpLmpvaW4oJywgJyk7XG59XG5cbi8qKiBUdXJucyB0aGUgdGFibGUgb2YgYEBnbGFuei9vcGVucGJyYCBpbnRvIGxpbmVzLCBncm91cCBieSBncm91cCBpbiB0aGUgc3BlY2lmaWNhdGlvbidzIG9yZGVyLiAqL1xuZXhwb3J0IGZ1bmN0aW9uIHBhcmFtZXRlclJvd3MoXG4gIHRhYmxlOiBSZWFkb25seTxSZWNvcmQ8c3RyaW5nLCBPcGVuUGJyUGFyYW1ldGVySW5mbz4+LFxuICBhY3Rpbmc6IHJlYWRvbmx5IHN0cmluZ1tdLFxuKTogUGFydGlhbDxSZWNvcmQ8T3BlblBickdyb3VwLCBQYXJhbWV0ZXJSb3dbXT4+IHtcbiAgY29uc3QgZ3JvdXBzOiBQYXJ0aWFsPFJlY29yZDxPcGVuUGJyR3JvdXAsIFBhcmFtZXRlclJvd1tdPj4gPSB7fTtcbiAgZm9yIChjb25zdCB7IG5hbWUsIGdyb3VwLCB0eXBlLCBkZWZhdWx0OiB2YWx1ZSwgcmFuZ2UsIHNvZnRSYW5nZSwgdW5pdCwgdGV4dHVyYWJsZSwgZG9jIH0gb2YgT2JqZWN0LnZhbHVlcyh0YWJsZSkpIHtcbiAgICBjb25zdCBzb2Z0ID0gaW50ZXJ2YWwoc29mdFJhbmdlKTtcbiAgICAoZ3JvdXBzW2dyb3VwXSA/Pz0gW10pLnB1c2goe1xuICAgICAgbmFtZSxcbiAgICAgIGdyb3VwLFxuICAgICAgdHlwZSxcbiAgICAgIGRlZmF1bHQ6IGluaXRpYWwodmFsdWUpLFxuICAgICAgcmFuZ2U6IGludGVydmFsKHJhbmdlKSxcbiAgICAgIHNvZnRSYW5nZTogc29mdCA9PT0gaW50ZXJ2YWwocmFuZ2UpID8gJycgOiBzb2Z0LFxuICAgICAgdW5pdDogcmFuZ2UgPyBVTklUU1t1bml0XSA6ICcnLFxuICAgICAgdGV4dHVyYWJsZSxcbiAgICAgIGFjdHM6IGFjdGluZy5pbmNsdWRlcyhuYW1lKSxcbiAgICAgIGRvYzogZG9jLnJlcGxhY2VBbGwoJ2AnLCAnJyksXG4gICAgfSk7XG4gIH1cbiAgcmV0dXJuIGdyb3Vwcztcbn1cbiIsICJjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZGlybmFtZSA9IFwiL3RtcC93dC1tZS9hcHBzL2RvY3Mvc3JjXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ZpbGVuYW1lID0gXCIvdG1wL3d0LW1lL2FwcHMvZG9jcy9zcmMvcmVhZC1leHBvcnQudHNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfaW1wb3J0X21ldGFfdXJsID0gXCJmaWxlOi8vL3RtcC93dC1tZS9hcHBzL2RvY3Mvc3JjL3JlYWQtZXhwb3J0LnRzXCI7aW1wb3J0IHsgZmlsZVVSTFRvUGF0aCB9IGZyb20gJ25vZGU6dXJsJztcbmltcG9ydCB7IGJ1aWxkIH0gZnJvbSAnZXNidWlsZCc7XG5pbXBvcnQgeyB3ZXNsU291cmNlIH0gZnJvbSAnLi4vLi4vLi4vdG9vbHMvcGlwZWxpbmUvd2VzbC5tanMnO1xuXG4vKipcbiAqIEV2YWx1YXRlcyBvbmUgZXhwb3J0IG9mIGEgbW9kdWxlIG9mIHRoaXMgcmVwb3NpdG9yeSwgZnJvbSBzb3VyY2VzLCBhdCBidWlsZCB0aW1lOiBwYWdlcyB0aGF0IHRlbGwgYWJvdXQgY29kZSByZWFkIGl0XG4gKiBpbnN0ZWFkIG9mIGNvcHlpbmcgaXQuXG4gKlxuICogQHBhcmFtIHNwZWNpZmllciBBIHBhY2thZ2UgZW50cnksIG9yIGEgcGF0aCByZWxhdGl2ZSB0byB0aGlzIGZvbGRlci5cbiAqL1xuZXhwb3J0IGFzeW5jIGZ1bmN0aW9uIHJlYWRFeHBvcnQoc3BlY2lmaWVyOiBzdHJpbmcsIG5hbWU6IHN0cmluZyk6IFByb21pc2U8dW5rbm93bj4ge1xuICBjb25zdCB7IG91dHB1dEZpbGVzIH0gPSBhd2FpdCBidWlsZCh7XG4gICAgc3RkaW46IHtcbiAgICAgIGNvbnRlbnRzOiBgZXhwb3J0IHsgJHtuYW1lfSBhcyB2YWx1ZSB9IGZyb20gJyR7c3BlY2lmaWVyfSc7YCxcbiAgICAgIHJlc29sdmVEaXI6IGZpbGVVUkxUb1BhdGgobmV3IFVSTCgnLicsIGltcG9ydC5tZXRhLnVybCkpLFxuICAgIH0sXG4gICAgY29uZGl0aW9uczogWydAZ2xhbnovc291cmNlJ10sXG4gICAgYnVuZGxlOiB0cnVlLFxuICAgIGZvcm1hdDogJ2VzbScsXG4gICAgcGxhdGZvcm06ICduZXV0cmFsJyxcbiAgICBwbHVnaW5zOiBbd2VzbFNvdXJjZSgpXSxcbiAgICB3cml0ZTogZmFsc2UsXG4gIH0pO1xuICBjb25zdCB7IHZhbHVlIH0gPSAoYXdhaXQgaW1wb3J0KFxuICAgIGBkYXRhOnRleHQvamF2YXNjcmlwdDtiYXNlNjQsJHtCdWZmZXIuZnJvbShvdXRwdXRGaWxlc1swXSEuY29udGVudHMpLnRvU3RyaW5nKCdiYXNlNjQnKX1gXG4gICkpIGFzIHsgdmFsdWU6IHVua25vd24gfTtcbiAgcmV0dXJuIHZhbHVlO1xufVxuIiwgImNvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9kaXJuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ZpbGVuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wubWpzXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCA9IFwiZmlsZTovLy90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC5tanNcIjsvLyBTaGFkZXIgc291cmNlIGluIFdFU0wgKGh0dHBzOi8vd2VzbC1sYW5nLmRldiksIHR1cm5lZCBpbnRvIHRoZSBtb2R1bGVzIHRoYXQgQGdsYW56L3dnc2wgY29tcG9zZXMgYXQgcnVuIHRpbWUuXG4vL1xuLy8gYGltcG9ydCBwYWNrYWdlOjphOjpiOjpuYW1lO2AgYmVjb21lcyBhIGRlcGVuZGVuY3ksIGBAaWYoRkxBRykgXHUyMDI2IEBlbGlmKEZMQUcpIFx1MjAyNiBAZWxzZSBcdTIwMjZgIG9uIGRlY2xhcmF0aW9ucywgbWVtYmVycyxcbi8vIHBhcmFtZXRlcnMsIHN0YXRlbWVudHMgYW5kIGltcG9ydHMgYmVjb21lcyBnYXRlcy4gTm90aGluZyBlbHNlIGNoYW5nZXMsIGFuZCBldmVyeSBsaW5lIGtlZXBzIGl0cyBudW1iZXI6IGxpbmUgbiBvZiBhXG4vLyBtb2R1bGUncyB0ZXh0IGlzIGxpbmUgbiBvZiBpdHMgZmlsZS4gTm8gcGFyc2VyIG9mIFdFU0wgaXMgaW4gd2hhdCB3ZSBwdWJsaXNoLlxuLy9cbi8vIEEgZmlsZSBvZiBjb25zdGFudHMgaXMgVHlwZVNjcmlwdCdzIHRvbzogc2VlIHdlc2wtY29uc3RhbnRzLm1qcy5cbmltcG9ydCB7IGV4aXN0c1N5bmMsIHJlYWRGaWxlU3luYyB9IGZyb20gJ25vZGU6ZnMnO1xuaW1wb3J0IHsgZGlybmFtZSwgam9pbiwgcmVsYXRpdmUsIHJlc29sdmUsIHNlcCB9IGZyb20gJ25vZGU6cGF0aCc7XG5pbXBvcnQgeyBleHBvcnRlZENvbnN0YW50cywgcmVhZENvbnN0YW50cyB9IGZyb20gJy4vd2VzbC1jb25zdGFudHMubWpzJztcbmltcG9ydCB7IHNob3J0ZW5Mb2NhbHMgfSBmcm9tICcuL3dlc2wtbmFtZXMubWpzJztcbmltcG9ydCB7IFdlc2xFcnJvciwgdG9rZW5pemUgfSBmcm9tICcuL3dlc2wtdG9rZW5zLm1qcyc7XG5cbmV4cG9ydCB7IFdlc2xFcnJvciB9O1xuXG5jb25zdCBDTE9TSU5HID0geyAnKCc6ICcpJywgJ1snOiAnXScsICd7JzogJ30nLCAnPCc6ICc+JyB9O1xuXG4vKipcbiAqIFJlYWRzIGEgV0VTTCBmaWxlLlxuICpcbiAqIEBwYXJhbSB7c3RyaW5nfSB0ZXh0XG4gKiBAcGFyYW0ge3N0cmluZ30gZmlsZSBGb3IgbWVzc2FnZXMuXG4gKiBAcmV0dXJucyB7eyBpbXBvcnRzOiB7IHBhdGg6IHN0cmluZ1tdLCBuYW1lOiBzdHJpbmcsIGZsYWc6IHN0cmluZyB8IHVuZGVmaW5lZCwgbGluZTogbnVtYmVyIH1bXSwgZWRpdHM6IHsgZnJvbTpcbiAqICAgbnVtYmVyLCB0bzogbnVtYmVyLCB0ZXh0OiBzdHJpbmcgfVtdLCBjb21tZW50czogeyBmcm9tOiBudW1iZXIsIHRvOiBudW1iZXIgfVtdLCB0b2tlbnM6IHsgdGV4dDogc3RyaW5nLCBmcm9tOiBudW1iZXIsXG4gKiAgIHRvOiBudW1iZXIgfVtdIH19IGBlZGl0c2AgdHVybiB0aGUgdGV4dCBpbnRvIG9uZSB3aXRoIGdhdGVzLiBgcGF0aGAgaXMgdGhlIG1vZHVsZSBvZiBhbiBpbXBvcnRlZCBuYW1lLlxuICogQHRocm93cyB7V2VzbEVycm9yfVxuICovXG5leHBvcnQgZnVuY3Rpb24gcGFyc2VXZXNsKHRleHQsIGZpbGUgPSAnbW9kdWxlLndlc2wnKSB7XG4gIGNvbnN0IGZhaWwgPSAoYXQsIG1lc3NhZ2UpID0+IHtcbiAgICB0aHJvdyBuZXcgV2VzbEVycm9yKGAke2ZpbGV9OiR7dGV4dC5zbGljZSgwLCBhdCkuc3BsaXQoJ1xcbicpLmxlbmd0aH06ICR7bWVzc2FnZX0uYCk7XG4gIH07XG4gIGNvbnN0IHsgdG9rZW5zLCBjb21tZW50cyB9ID0gdG9rZW5pemUodGV4dCwgZmFpbCk7XG4gIGNvbnN0IGltcG9ydHMgPSBbXTtcbiAgY29uc3QgZWRpdHMgPSBbXTtcbiAgbGV0IG5leHQgPSAwO1xuICBjb25zdCBwZWVrID0gKCkgPT4gdG9rZW5zW25leHRdPy50ZXh0O1xuICBjb25zdCBoZXJlID0gKCkgPT4gdG9rZW5zW25leHRdPy5mcm9tID8/IHRleHQubGVuZ3RoO1xuICBjb25zdCB0YWtlID0gKGV4cGVjdGVkKSA9PiB7XG4gICAgY29uc3QgdG9rZW4gPSB0b2tlbnNbbmV4dF07XG4gICAgaWYgKCF0b2tlbikgcmV0dXJuIGZhaWwodGV4dC5sZW5ndGgsIGV4cGVjdGVkID8gYFwiJHtleHBlY3RlZH1cIiBpcyBtaXNzaW5nIGF0IHRoZSBlbmRgIDogJ3RoZSBmaWxlIGVuZHMgdG9vIHNvb24nKTtcbiAgICBpZiAoZXhwZWN0ZWQgIT09IHVuZGVmaW5lZCAmJiB0b2tlbi50ZXh0ICE9PSBleHBlY3RlZClcbiAgICAgIGZhaWwodG9rZW4uZnJvbSwgYFwiJHt0b2tlbi50ZXh0fVwiIHN0YW5kcyB3aGVyZSBcIiR7ZXhwZWN0ZWR9XCIgaXMgZXhwZWN0ZWRgKTtcbiAgICBuZXh0Kys7XG4gICAgcmV0dXJuIHRva2VuO1xuICB9O1xuICBjb25zdCBlbmRPZkxhc3QgPSAoKSA9PiB0b2tlbnNbbmV4dCAtIDFdLnRvO1xuXG4gIC8qKiBTa2lwcyB0aGUgYnJhY2tldCB0aGF0IGlzIG5leHQsIHdpdGggYWxsIHRoYXQgaXQgZW5jbG9zZXMuICovXG4gIGNvbnN0IHNraXBCcmFja2V0ID0gKCkgPT4ge1xuICAgIGNvbnN0IG9wZW4gPSB0YWtlKCk7XG4gICAgZm9yIChjb25zdCBjbG9zZSA9IENMT1NJTkdbb3Blbi50ZXh0XTsgcGVlaygpICE9PSBjbG9zZTspIHNraXBUb2tlbigpO1xuICAgIHRha2UoKTtcbiAgfTtcbiAgY29uc3Qgc2tpcFRva2VuID0gKCkgPT4ge1xuICAgIGlmIChwZWVrKCkgPT09IHVuZGVmaW5lZCkgZmFpbCh0ZXh0Lmxlbmd0aCwgJ3RoZSBmaWxlIGVuZHMgaW5zaWRlIG9mIGEgYnJhY2tldCcpO1xuICAgIGlmIChwZWVrKCkgPT09ICdAJyAmJiAvXihpZnxlbGlmfGVsc2UpJC8udGVzdCh0b2tlbnNbbmV4dCArIDFdPy50ZXh0ID8/ICcnKSlcbiAgICAgIGZhaWwoXG4gICAgICAgIGhlcmUoKSxcbiAgICAgICAgYEAke3Rva2Vuc1tuZXh0ICsgMV0udGV4dH0gc3RhbmRzIHdoZXJlIG5vIGRlY2xhcmF0aW9uLCBtZW1iZXIsIHBhcmFtZXRlciwgc3RhdGVtZW50IG9yIGltcG9ydCBiZWdpbnNgLFxuICAgICAgKTtcbiAgICBpZiAocGVlaygpIGluIENMT1NJTkcgJiYgcGVlaygpICE9PSAnPCcpIHNraXBCcmFja2V0KCk7XG4gICAgZWxzZSB0YWtlKCk7XG4gIH07XG4gIGNvbnN0IHNraXBUbyA9ICguLi5lbmRzKSA9PiB7XG4gICAgd2hpbGUgKCFlbmRzLmluY2x1ZGVzKHBlZWsoKSkpIHNraXBUb2tlbigpO1xuICB9O1xuXG4gIC8qKiBgKEEgJiYgIUIpYCBhcyB0aGUgY29tcG9zZXIgcmVhZHMgaXQsIGBBJiYhQmAuICovXG4gIGNvbnN0IGNvbmRpdGlvbiA9ICgpID0+IHtcbiAgICBjb25zdCBmcm9tID0gdGFrZSgnKCcpLmZyb207XG4gICAgY29uc3QgcGFydHMgPSBbXTtcbiAgICBkbyB7XG4gICAgICBpZiAocGFydHMubGVuZ3RoID4gMCkgdGFrZSgnJiYnKTtcbiAgICAgIGxldCBuZWdhdGVkID0gZmFsc2U7XG4gICAgICB3aGlsZSAocGVlaygpID09PSAnIScpIHtcbiAgICAgICAgdGFrZSgpO1xuICAgICAgICBuZWdhdGVkID0gIW5lZ2F0ZWQ7XG4gICAgICB9XG4gICAgICBjb25zdCBmbGFnID0gdGFrZSgpO1xuICAgICAgaWYgKCEvXltBLVphLXpfXVxcdyokLy50ZXN0KGZsYWcudGV4dCkpXG4gICAgICAgIGZhaWwoXG4gICAgICAgICAgZmxhZy5mcm9tLFxuICAgICAgICAgICdhIGNvbmRpdGlvbiBpcyBhIGZsYWcsICFmbGFnLCBvciBzZXZlcmFsIG9mIHRoZW0gd2l0aCAmJiBiZXR3ZWVuOyBmb3IgfHwgdXNlIGEgZmxhZyB0aGF0IHN0YW5kcyBmb3IgYm90aCcsXG4gICAgICAgICk7XG4gICAgICBwYXJ0cy5wdXNoKGAke25lZ2F0ZWQgPyAnIScgOiAnJ30ke2ZsYWcudGV4dH1gKTtcbiAgICB9IHdoaWxlIChwZWVrKCkgPT09ICcmJicpO1xuICAgIGlmIChwZWVrKCkgIT09ICcpJylcbiAgICAgIGZhaWwoXG4gICAgICAgIGZyb20sXG4gICAgICAgICdhIGNvbmRpdGlvbiBpcyBhIGZsYWcsICFmbGFnLCBvciBzZXZlcmFsIG9mIHRoZW0gd2l0aCAmJiBiZXR3ZWVuOyBmb3IgfHwgdXNlIGEgZmxhZyB0aGF0IHN0YW5kcyBmb3IgYm90aCcsXG4gICAgICApO1xuICAgIHRha2UoJyknKTtcbiAgICByZXR1cm4gcGFydHMuam9pbignJiYnKTtcbiAgfTtcblxuICAvKiogVGhlIGF0dHJpYnV0ZXMgYmVmb3JlIGFuIGVsZW1lbnQ7IGF0IG1vc3Qgb25lIG9mIHRoZW0gaXMgYSBnYXRlLiAqL1xuICBjb25zdCBhdHRyaWJ1dGVzID0gKCkgPT4ge1xuICAgIGxldCBnYXRlO1xuICAgIHdoaWxlIChwZWVrKCkgPT09ICdAJykge1xuICAgICAgY29uc3QgeyBmcm9tIH0gPSB0YWtlKCdAJyk7XG4gICAgICBjb25zdCBuYW1lID0gdGFrZSgpO1xuICAgICAgaWYgKC9eKGlmfGVsaWZ8ZWxzZSkkLy50ZXN0KG5hbWUudGV4dCkpIHtcbiAgICAgICAgaWYgKGdhdGUpIGZhaWwoZnJvbSwgJ2FuIGVsZW1lbnQgaGFzIHR3byBjb25kaXRpb25zOiBqb2luIHRoZW0gYnkgJiYnKTtcbiAgICAgICAgZ2F0ZSA9IHsga2luZDogbmFtZS50ZXh0LCBmcm9tLCBjb25kaXRpb246IG5hbWUudGV4dCA9PT0gJ2Vsc2UnID8gdW5kZWZpbmVkIDogY29uZGl0aW9uKCksIHRvOiAwIH07XG4gICAgICAgIGdhdGUudG8gPSBlbmRPZkxhc3QoKTtcbiAgICAgIH0gZWxzZSBpZiAocGVlaygpID09PSAnKCcpIHNraXBCcmFja2V0KCk7XG4gICAgfVxuICAgIHJldHVybiBnYXRlO1xuICB9O1xuXG4gIGNvbnN0IGltcG9ydFRyZWUgPSAocGF0aCkgPT4ge1xuICAgIGNvbnN0IGZvdW5kID0gW107XG4gICAgY29uc3QgYnJhbmNoID0gKGJlZm9yZSkgPT4ge1xuICAgICAgaWYgKHBlZWsoKSA9PT0gJ3snKSB7XG4gICAgICAgIHRha2UoJ3snKTtcbiAgICAgICAgd2hpbGUgKHBlZWsoKSAhPT0gJ30nKSB7XG4gICAgICAgICAgYnJhbmNoKGJlZm9yZSk7XG4gICAgICAgICAgaWYgKHBlZWsoKSAhPT0gJ30nKSB0YWtlKCcsJyk7XG4gICAgICAgIH1cbiAgICAgICAgdGFrZSgnfScpO1xuICAgICAgICByZXR1cm47XG4gICAgICB9XG4gICAgICBjb25zdCBuYW1lID0gdGFrZSgpO1xuICAgICAgaWYgKCEvXltBLVphLXpfXVxcdyokLy50ZXN0KG5hbWUudGV4dCkpIGZhaWwobmFtZS5mcm9tLCBgXCIke25hbWUudGV4dH1cIiBpcyBubyBuYW1lIHRvIGltcG9ydGApO1xuICAgICAgaWYgKHBlZWsoKSA9PT0gJzo6Jykge1xuICAgICAgICB0YWtlKCc6OicpO1xuICAgICAgICBicmFuY2goWy4uLmJlZm9yZSwgbmFtZS50ZXh0XSk7XG4gICAgICB9IGVsc2UgaWYgKHBlZWsoKSA9PT0gJ2FzJykgZmFpbChoZXJlKCksICdpbXBvcnRzIGNhbm5vdCBiZSByZW5hbWVkOiBuYW1lcyBhcmUgdW5pcXVlIGluIGFsbCBvZiB0aGUgcHJvamVjdCcpO1xuICAgICAgZWxzZSBmb3VuZC5wdXNoKHsgcGF0aDogYmVmb3JlLCBuYW1lOiBuYW1lLnRleHQsIGF0OiBuYW1lLmZyb20gfSk7XG4gICAgfTtcbiAgICBicmFuY2gocGF0aCk7XG4gICAgcmV0dXJuIGZvdW5kO1xuICB9O1xuXG4gIGNvbnN0IGltcG9ydFN0YXRlbWVudCA9IChmcm9tLCBnYXRlKSA9PiB7XG4gICAgaWYgKGdhdGUgJiYgKGdhdGUua2luZCAhPT0gJ2lmJyB8fCBnYXRlLmNvbmRpdGlvbi5pbmNsdWRlcygnJicpKSlcbiAgICAgIGZhaWwoZnJvbSwgJ2FuIGltcG9ydCBpcyBnYXRlZCBieSBAaWYoRkxBRykgb3IgQGlmKCFGTEFHKScpO1xuICAgIHRha2UoJ2ltcG9ydCcpO1xuICAgIGZvciAoY29uc3QgeyBwYXRoLCBuYW1lLCBhdCB9IG9mIGltcG9ydFRyZWUoW10pKSB7XG4gICAgICBpZiAocGF0aC5sZW5ndGggPT09IDApIGZhaWwoYXQsIGBcImltcG9ydCAke25hbWV9XCIgbmFtZXMgbm8gbW9kdWxlYCk7XG4gICAgICBpbXBvcnRzLnB1c2goeyBwYXRoLCBuYW1lLCBmbGFnOiBnYXRlPy5jb25kaXRpb24sIGxpbmU6IHRleHQuc2xpY2UoMCwgYXQpLnNwbGl0KCdcXG4nKS5sZW5ndGggfSk7XG4gICAgfVxuICAgIHRha2UoJzsnKTtcbiAgICAvLyBMaW5lIGJyZWFrcyBzdGF5LlxuICAgIGVkaXRzLnB1c2goeyBmcm9tLCB0bzogZW5kT2ZMYXN0KCksIHRleHQ6IHRleHQuc2xpY2UoZnJvbSwgZW5kT2ZMYXN0KCkpLnJlcGxhY2UoL1teXFxuXSsvZywgJycpIH0pO1xuICB9O1xuXG4gIGNvbnN0IGJsb2NrID0gKCkgPT4ge1xuICAgIHRha2UoJ3snKTtcbiAgICBzZXF1ZW5jZShzdGF0ZW1lbnQsICd9Jyk7XG4gICAgdGFrZSgnfScpO1xuICB9O1xuXG4gIGNvbnN0IGRlY2xhcmF0aW9uID0gKCkgPT4ge1xuICAgIGlmIChwZWVrKCkgPT09ICdmbicpIHtcbiAgICAgIHRha2UoKTtcbiAgICAgIHRha2UoKTtcbiAgICAgIHRha2UoJygnKTtcbiAgICAgIHNlcXVlbmNlKGxpc3RlZCgnKScpLCAnKScpO1xuICAgICAgdGFrZSgnKScpO1xuICAgICAgc2tpcFRvKCd7Jyk7XG4gICAgICBibG9jaygpO1xuICAgIH0gZWxzZSBpZiAocGVlaygpID09PSAnc3RydWN0Jykge1xuICAgICAgdGFrZSgpO1xuICAgICAgdGFrZSgpO1xuICAgICAgdGFrZSgneycpO1xuICAgICAgc2VxdWVuY2UobGlzdGVkKCd9JyksICd9Jyk7XG4gICAgICB0YWtlKCd9Jyk7XG4gICAgICBpZiAocGVlaygpID09PSAnOycpIHRha2UoKTtcbiAgICB9IGVsc2Uge1xuICAgICAgaWYgKHBlZWsoKSAhPT0gJzsnKSBza2lwVG8oJzsnKTtcbiAgICAgIHRha2UoJzsnKTtcbiAgICB9XG4gIH07XG5cbiAgLyoqIEEgbWVtYmVyIG9mIGEgc3RydWN0IG9yIGEgcGFyYW1ldGVyLiAqL1xuICBjb25zdCBsaXN0ZWQgPSAoY2xvc2UpID0+ICgpID0+IHtcbiAgICBsZXQgZGVwdGggPSAwO1xuICAgIHdoaWxlIChkZXB0aCA+IDAgfHwgKHBlZWsoKSAhPT0gJywnICYmIHBlZWsoKSAhPT0gY2xvc2UpKSB7XG4gICAgICBpZiAocGVlaygpID09PSAnPCcpIGRlcHRoKys7XG4gICAgICBpZiAocGVlaygpID09PSAnPicpIGRlcHRoLS07XG4gICAgICBza2lwVG9rZW4oKTtcbiAgICB9XG4gICAgaWYgKHBlZWsoKSA9PT0gJywnKSB0YWtlKCk7XG4gIH07XG5cbiAgY29uc3QgY2xhdXNlID0gKCkgPT4ge1xuICAgIGlmIChwZWVrKCkgIT09ICdjYXNlJyAmJiBwZWVrKCkgIT09ICdkZWZhdWx0JykgZmFpbChoZXJlKCksIGBcIiR7cGVlaygpfVwiIHN0YW5kcyB3aGVyZSBhIGNhc2UgaXMgZXhwZWN0ZWRgKTtcbiAgICBza2lwVG8oJ3snKTtcbiAgICBibG9jaygpO1xuICB9O1xuXG4gIGNvbnN0IHN0YXRlbWVudCA9ICgpID0+IHtcbiAgICBzd2l0Y2ggKHBlZWsoKSkge1xuICAgICAgY2FzZSAneyc6XG4gICAgICAgIHJldHVybiBibG9jaygpO1xuICAgICAgY2FzZSAnaWYnOlxuICAgICAgY2FzZSAnZm9yJzpcbiAgICAgIGNhc2UgJ3doaWxlJzpcbiAgICAgICAgdGFrZSgpO1xuICAgICAgICBza2lwVG8oJ3snKTtcbiAgICAgICAgYmxvY2soKTtcbiAgICAgICAgd2hpbGUgKHBlZWsoKSA9PT0gJ2Vsc2UnKSB7XG4gICAgICAgICAgdGFrZSgpO1xuICAgICAgICAgIHNraXBUbygneycpO1xuICAgICAgICAgIGJsb2NrKCk7XG4gICAgICAgIH1cbiAgICAgICAgcmV0dXJuIHVuZGVmaW5lZDtcbiAgICAgIGNhc2UgJ2xvb3AnOlxuICAgICAgY2FzZSAnY29udGludWluZyc6XG4gICAgICAgIHRha2UoKTtcbiAgICAgICAgc2tpcFRvKCd7Jyk7XG4gICAgICAgIHJldHVybiBibG9jaygpO1xuICAgICAgY2FzZSAnc3dpdGNoJzpcbiAgICAgICAgdGFrZSgpO1xuICAgICAgICBza2lwVG8oJ3snKTtcbiAgICAgICAgdGFrZSgneycpO1xuICAgICAgICBzZXF1ZW5jZShjbGF1c2UsICd9Jyk7XG4gICAgICAgIHRha2UoJ30nKTtcbiAgICAgICAgcmV0dXJuIHVuZGVmaW5lZDtcbiAgICAgIGRlZmF1bHQ6XG4gICAgICAgIHNraXBUbygnOycsICd9Jyk7XG4gICAgICAgIHRha2UoJzsnKTtcbiAgICAgICAgcmV0dXJuIHVuZGVmaW5lZDtcbiAgICB9XG4gIH07XG5cbiAgLyoqIEVsZW1lbnRzIHVwIHRvIGEgY2xvc2luZyBicmFja2V0LCBvciB0byB0aGUgZW5kIG9mIHRoZSBmaWxlLCB3aXRoIHRoZWlyIGNoYWlucyBvZiBjb25kaXRpb25zLiAqL1xuICBjb25zdCBzZXF1ZW5jZSA9IChlbGVtZW50LCBjbG9zZSkgPT4ge1xuICAgIC8vIEhvdyBtYW55IGdhdGVzIG9mIHRoZSBjaGFpbiBhcmUgb3BlbiwgYW5kIHRoZSBjb25kaXRpb24gb2YgYSBjaGFpbiB0aGF0IGlzIG9uZSBAaWYgYWxvbmUuXG4gICAgbGV0IG9wZW4gPSAwO1xuICAgIGxldCBlbmQgPSAwO1xuICAgIGxldCBhbG9uZTtcbiAgICBjb25zdCBjbG9zZUNoYWluID0gKCkgPT4ge1xuICAgICAgaWYgKG9wZW4gPiAwKVxuICAgICAgICBlZGl0cy5wdXNoKHsgZnJvbTogZW5kLCB0bzogZW5kLCB0ZXh0OiBgJHsnLy8jZW5kaWYnLnJlcGVhdChvcGVuKX0key9cXHcvLnRlc3QodGV4dFtlbmRdID8/ICcnKSA/ICcgJyA6ICcnfWAgfSk7XG4gICAgICBvcGVuID0gMDtcbiAgICAgIGFsb25lID0gdW5kZWZpbmVkO1xuICAgIH07XG4gICAgd2hpbGUgKHBlZWsoKSAhPT0gY2xvc2UpIHtcbiAgICAgIGlmIChwZWVrKCkgPT09IHVuZGVmaW5lZCkgZmFpbCh0ZXh0Lmxlbmd0aCwgYFwiJHtjbG9zZX1cIiBpcyBtaXNzaW5nIGF0IHRoZSBlbmRgKTtcbiAgICAgIGNvbnN0IGZyb20gPSBoZXJlKCk7XG4gICAgICBjb25zdCBnYXRlID0gYXR0cmlidXRlcygpO1xuICAgICAgLy8gTmVpZ2hib3VycyBvZiBvbmUgY29uZGl0aW9uIHNoYXJlIGEgZ2F0ZS5cbiAgICAgIGNvbnN0IHNoYXJlZCA9IGdhdGU/LmtpbmQgPT09ICdpZicgJiYgZ2F0ZS5jb25kaXRpb24gPT09IGFsb25lICYmIHBlZWsoKSAhPT0gJ2ltcG9ydCc7XG4gICAgICBpZiAoKCFnYXRlIHx8IGdhdGUua2luZCA9PT0gJ2lmJykgJiYgIXNoYXJlZCkgY2xvc2VDaGFpbigpO1xuICAgICAgaWYgKHBlZWsoKSA9PT0gJ2ltcG9ydCcgJiYgY2xvc2UgPT09IHVuZGVmaW5lZCkge1xuICAgICAgICBpbXBvcnRTdGF0ZW1lbnQoZnJvbSwgZ2F0ZSk7XG4gICAgICAgIGNvbnRpbnVlO1xuICAgICAgfVxuICAgICAgaWYgKGdhdGUpIHtcbiAgICAgICAgaWYgKGdhdGUua2luZCAhPT0gJ2lmJyAmJiBvcGVuID09PSAwKSBmYWlsKGdhdGUuZnJvbSwgYEAke2dhdGUua2luZH0gd2l0aG91dCBAaWYgYmVmb3JlIGl0YCk7XG4gICAgICAgIGNvbnN0IHN0YXJ0ID0gZ2F0ZS5raW5kID09PSAnaWYnID8gJycgOiAnLy8jZWxzZSc7XG4gICAgICAgIGNvbnN0IGdhcCA9IC9cXHMvLnRlc3QodGV4dFtnYXRlLnRvXSA/PyAnICcpID8gJycgOiAnICc7XG4gICAgICAgIGNvbnN0IG1hcmtzID0gc2hhcmVkID8gJycgOiBgJHtzdGFydH0ke2dhdGUuY29uZGl0aW9uID09PSB1bmRlZmluZWQgPyAnJyA6IGAvLyNpZiAke2dhdGUuY29uZGl0aW9ufWB9YDtcbiAgICAgICAgZWRpdHMucHVzaCh7IGZyb206IGdhdGUuZnJvbSwgdG86IGdhdGUudG8sIHRleHQ6IGAke21hcmtzfSR7Z2FwfWAgfSk7XG4gICAgICAgIGlmIChnYXRlLmNvbmRpdGlvbiAhPT0gdW5kZWZpbmVkICYmICFzaGFyZWQpIG9wZW4rKztcbiAgICAgICAgYWxvbmUgPSBnYXRlLmtpbmQgPT09ICdpZicgPyBnYXRlLmNvbmRpdGlvbiA6IHVuZGVmaW5lZDtcbiAgICAgIH1cbiAgICAgIGVsZW1lbnQoKTtcbiAgICAgIGVuZCA9IGVuZE9mTGFzdCgpO1xuICAgICAgaWYgKGdhdGU/LmtpbmQgPT09ICdlbHNlJykgY2xvc2VDaGFpbigpO1xuICAgIH1cbiAgICBjbG9zZUNoYWluKCk7XG4gIH07XG5cbiAgc2VxdWVuY2UoZGVjbGFyYXRpb24sIHVuZGVmaW5lZCk7XG4gIGZvciAoY29uc3QgeyBmcm9tLCB0byB9IG9mIGNvbW1lbnRzKVxuICAgIGlmICh0ZXh0LnNsaWNlKGZyb20sIHRvKS5pbmNsdWRlcygnLy8jJykpIGZhaWwoZnJvbSwgJ2EgY29tbWVudCBtdXN0IG5vdCBob2xkIFwiLy8jXCIsIHdoaWNoIG1hcmtzIGdhdGVzJyk7XG4gIHJldHVybiB7IGltcG9ydHMsIGVkaXRzLCBjb21tZW50cywgdG9rZW5zIH07XG59XG5cbmNvbnN0IE9QRVJBVE9SID0gL1stKyovJT08PiEmfF5+XS87XG5cbi8qKlxuICogQSBsaW5lIG9mIFdHU0wgd2l0aG91dCB0aGUgc3BhY2VzIHRoYXQgc2VwYXJhdGUgbm90aGluZzogdGhvc2UgYmVzaWRlIHB1bmN0dWF0aW9uLiBCZXR3ZWVuIHR3byBvcGVyYXRvcnMgdGhleSBzdGF5LFxuICogZm9yIGBhIC0gLWJgIGFuZCBgYXJyYXk8ZjMyPiA9IHhgIG1lYW4gc29tZXRoaW5nIGVsc2Ugd2l0aG91dCB0aGVtLiBMaW5lcyB3aXRoIGNvbW1lbnRzIHN0YXkgYXMgdGhleSBhcmUuXG4gKi9cbmV4cG9ydCBmdW5jdGlvbiBjbG9zZVVwKGxpbmUpIHtcbiAgaWYgKGxpbmUuaW5jbHVkZXMoJy8vJykpIHJldHVybiBsaW5lO1xuICBjb25zdCBjbG9zZWQgPSBsaW5lLnJlcGxhY2UoLyg/PD0oXFxTKSkgKyg/PShcXFMpKS9nLCAoc3BhY2VzLCBiZWZvcmUsIGFmdGVyKSA9PiB7XG4gICAgY29uc3Qgc2VwYXJhdGVzID0gL1xcdy8udGVzdChiZWZvcmUpICYmIC9cXHcvLnRlc3QoYWZ0ZXIpO1xuICAgIHJldHVybiBzZXBhcmF0ZXMgfHwgKE9QRVJBVE9SLnRlc3QoYmVmb3JlKSAmJiBPUEVSQVRPUi50ZXN0KGFmdGVyKSkgPyBzcGFjZXMgOiAnJztcbiAgfSk7XG4gIC8vIDEuMCBpcyAxLiBhbmQgMC41IGlzIC41OyB3aGF0IGEgc3Vic3RpdHV0aW9uIG1heSBnbyBvbiB3aXRoIHN0YXlzLlxuICByZXR1cm4gY2xvc2VkLnJlcGxhY2UoLyg/PD1cXGRcXC4pMCg/PVteXFx3Ll0pL2csICcnKS5yZXBsYWNlKC8oPzwhW1xcdy5dKTAoPz1cXC5cXGQpL2csICcnKTtcbn1cblxuLyoqIEEgbGluZSB3aXRoIGdhdGVzLCB3aXRob3V0IHRoZSBzcGFjZXMgdGhhdCBzZXBhcmF0ZSBub3RoaW5nLiAqL1xuY29uc3QgY2xvc2VVcEdhdGVkID0gKGxpbmUpID0+XG4gIGxpbmVcbiAgICAuc3BsaXQoLyhcXC9cXC8jKD86aWYgW1xcdyEmXSt8ZWxzZXxlbmRpZikpLylcbiAgICAubWFwKChwYXJ0LCBpKSA9PiB7XG4gICAgICBpZiAoaSAlIDIpIHJldHVybiBwYXJ0O1xuICAgICAgY29uc3Qgc2h1dCA9IGNsb3NlVXAocGFydC50cmltKCkpO1xuICAgICAgcmV0dXJuIGkgPiAwICYmIC9eXFx3Ly50ZXN0KHNodXQpID8gYCAke3NodXR9YCA6IHNodXQ7XG4gICAgfSlcbiAgICAuam9pbignJyk7XG5cbmZ1bmN0aW9uIGFwcGx5KHRleHQsIGVkaXRzKSB7XG4gIGxldCByZXN1bHQgPSB0ZXh0O1xuICBmb3IgKGNvbnN0IGVkaXQgb2YgWy4uLmVkaXRzXS5zb3J0KChhLCBiKSA9PiBiLmZyb20gLSBhLmZyb20gfHwgYi50byAtIGEudG8pKVxuICAgIHJlc3VsdCA9IHJlc3VsdC5zbGljZSgwLCBlZGl0LmZyb20pICsgZWRpdC50ZXh0ICsgcmVzdWx0LnNsaWNlKGVkaXQudG8pO1xuICByZXR1cm4gcmVzdWx0O1xufVxuXG4vKipcbiAqIFRoZSB0ZXh0IHdpdGggZ2F0ZXMgZm9yIHRoZSBjb21wb3NlciwgbGluZSBieSBsaW5lIHRoYXQgb2YgdGhlIGZpbGUuIEBwYXJhbSB7Ym9vbGVhbn0gc2hyaW5rIFdpdGhvdXQgY29tbWVudHMgYW5kXG4gKiBzcGFjZXMgdGhhdCBzZXBhcmF0ZSBub3RoaW5nLCBhbmQgd2l0aCBzaG9ydCBuYW1lcyBpbiBmdW5jdGlvbnMuXG4gKi9cbmZ1bmN0aW9uIGdhdGVkVGV4dCh0ZXh0LCB7IGVkaXRzLCBjb21tZW50cywgdG9rZW5zIH0sIHNocmluaykge1xuICBpZiAoIXNocmluaykgcmV0dXJuIGFwcGx5KHRleHQsIGVkaXRzKTtcbiAgY29uc3QgYmFyZSA9IGFwcGx5KHRleHQsIFtcbiAgICAuLi5lZGl0cyxcbiAgICAuLi5zaG9ydGVuTG9jYWxzKHRva2VucyksXG4gICAgLi4uY29tbWVudHMubWFwKCh7IGZyb20sIHRvIH0pID0+ICh7IGZyb20sIHRvLCB0ZXh0OiB0ZXh0LnNsaWNlKGZyb20sIHRvKS5yZXBsYWNlKC9bXlxcbl0rL2csICcnKSB8fCAnICcgfSkpLFxuICBdKTtcbiAgcmV0dXJuIGJhcmUuc3BsaXQoJ1xcbicpLm1hcChjbG9zZVVwR2F0ZWQpLmpvaW4oJ1xcbicpO1xufVxuXG4vKiogVGhlIG5lYXJlc3QgZm9sZGVyIHdpdGggYSBwYWNrYWdlLmpzb24sIGFuZCBpdHMgbmFtZSB3aXRob3V0IHRoZSBzY29wZS4gKi9cbmZ1bmN0aW9uIHBhY2thZ2VPZihmaWxlKSB7XG4gIGZvciAobGV0IGZvbGRlciA9IGRpcm5hbWUoZmlsZSk7IGZvbGRlciAhPT0gZGlybmFtZShmb2xkZXIpOyBmb2xkZXIgPSBkaXJuYW1lKGZvbGRlcikpIHtcbiAgICBjb25zdCBtYW5pZmVzdCA9IGpvaW4oZm9sZGVyLCAncGFja2FnZS5qc29uJyk7XG4gICAgaWYgKGV4aXN0c1N5bmMobWFuaWZlc3QpKVxuICAgICAgcmV0dXJuIHsgZm9sZGVyLCBzaG9ydDogSlNPTi5wYXJzZShyZWFkRmlsZVN5bmMobWFuaWZlc3QsICd1dGY4JykpLm5hbWUuc3BsaXQoJy8nKS5hdCgtMSkgfTtcbiAgfVxuICB0aHJvdyBuZXcgV2VzbEVycm9yKGAke2ZpbGV9OiBpdCBsaWVzIGluIG5vIHBhY2thZ2UuYCk7XG59XG5cbi8qKlxuICogV2hldGhlciBhbiBpbXBvcnRlZCBuYW1lIGlzIGEgbnVtYmVyOiB0aG9zZSBvZiBUeXBlU2NyaXB0IGFyZSBpbiBjYXBpdGFscy4gSXQgc3RhbmRzIGluIHRoZSB0ZXh0IGFzIGEgbGl0ZXJhbCB1MzIsIHNvXG4gKiB0aGF0IGhvc3RzIGFuZCBzaGFkZXJzIHNoYXJlIG9uZSB0YWJsZS5cbiAqL1xuY29uc3QgaXNOdW1iZXIgPSAobmFtZSkgPT4gL15bQS1aXVtBLVpcXGRdKig/Ol9bQS1aXFxkXSspKiQvLnRlc3QobmFtZSk7XG5cbi8qKiBGaWxlcyB0aGF0IG9ubHkgZGVjbGFyZSB3aGF0IHRoZSBob3N0IG9mIGEgbGlicmFyeSBzdXBwbGllcywgc28gdGhhdCBlZGl0b3JzIGtub3cgaXQuICovXG5leHBvcnQgY29uc3QgaXNIb3N0ID0gKHBhdGgpID0+IHBhdGguYXQoLTEpID09PSAnaG9zdCc7XG5cbi8qKlxuICogVGhlIGZpbGUgdGhhdCBhbiBpbXBvcnRlZCBtb2R1bGUgaXMgaW4uXG4gKiBAcmV0dXJucyB7eyBmaWxlOiBzdHJpbmcsIHdlc2w6IGJvb2xlYW4gfX0gYHdlc2xgIGZhbHNlOiBUeXBlU2NyaXB0IHRoYXQgZXhwb3J0cyBhIG1vZHVsZSBieSB0aGUgaW1wb3J0ZWQgbmFtZS5cbiAqIEB0aHJvd3Mge1dlc2xFcnJvcn1cbiAqL1xuZnVuY3Rpb24gcmVzb2x2ZU1vZHVsZSh7IHBhdGgsIG5hbWUsIGxpbmUgfSwgZmlsZSwgc291cmNlKSB7XG4gIGNvbnN0IFtyb290LCAuLi5yZXN0XSA9IHBhdGg7XG4gIGNvbnN0IGZvbGRlciA9IHJvb3QgPT09ICdwYWNrYWdlJyA/IHNvdXJjZSA6IHJvb3QgPT09ICdzdXBlcicgPyBkaXJuYW1lKGZpbGUpIDogdW5kZWZpbmVkO1xuICBpZiAoZm9sZGVyID09PSB1bmRlZmluZWQpIHRocm93IG5ldyBXZXNsRXJyb3IoYCR7ZmlsZX06JHtsaW5lfTogXCIke3Jvb3R9XCIgaXMgbm8gcm9vdCBvZiBhIHBhdGg6IHBhY2thZ2Ugb3Igc3VwZXIuYCk7XG4gIGNvbnN0IGJhc2UgPSByZXNvbHZlKGZvbGRlciwgLi4ucmVzdCk7XG4gIGlmIChleGlzdHNTeW5jKGAke2Jhc2V9Lndlc2xgKSkgcmV0dXJuIHsgZmlsZTogYCR7YmFzZX0ud2VzbGAsIHdlc2w6IHRydWUgfTtcbiAgY29uc3QgdHlwZXNjcmlwdCA9IGAke2pvaW4oZGlybmFtZShiYXNlKSwgKHJlc3QuYXQoLTEpID8/ICcnKS5yZXBsYWNlQWxsKCdfJywgJy0nKSl9LnRzYDtcbiAgaWYgKGV4aXN0c1N5bmModHlwZXNjcmlwdCkpIHJldHVybiB7IGZpbGU6IHR5cGVzY3JpcHQsIHdlc2w6IGZhbHNlIH07XG4gIHRocm93IG5ldyBXZXNsRXJyb3IoXG4gICAgYCR7ZmlsZX06JHtsaW5lfTogdGhlcmUgaXMgbm8gbW9kdWxlICR7cGF0aC5qb2luKCc6OicpfSB0byBpbXBvcnQgJHtuYW1lfSBmcm9tOiBuZWl0aGVyICR7YmFzZX0ud2VzbCBub3IgJHt0eXBlc2NyaXB0fS5gLFxuICApO1xufVxuXG4vKipcbiAqIEEgV0VTTCBmaWxlIGFzIGEgSmF2YVNjcmlwdCBtb2R1bGUgd2hvc2UgZGVmYXVsdCBleHBvcnQgaXMgaXRzIGBXZ3NsTW9kdWxlYC4gSXRzIG5hbWUgaXMgYDxwYWNrYWdlPi88ZmlsZT5gLCB3aXRoXG4gKiBoeXBoZW5zIGZvciB1bmRlcnNjb3Jlcy4gVGhlIGNvbnN0YW50cyBvZiBhIGZpbGUgdGhhdCBob2xkcyBub3RoaW5nIGVsc2UgYXJlIGV4cG9ydGVkIGJ5IHRoZWlyIG5hbWVzLlxuICpcbiAqIEBwYXJhbSB7c3RyaW5nfSB0ZXh0XG4gKiBAcGFyYW0ge3N0cmluZ30gZmlsZSBBYnNvbHV0ZSBwYXRoLlxuICogQHBhcmFtIHt7IHNocmluaz86IGJvb2xlYW4sIHBhZ2U/OiBib29sZWFuIH19IG9wdGlvbnMgYHNocmlua2A6IGxlYXZlcyBvdXQgY29tbWVudHMgYW5kIHNwYWNlcywgYW5kIHNob3J0ZW5zIG5hbWVzIGluXG4gKiAgIGZ1bmN0aW9ucywgZm9yIHdoYXQgaXMgcHVibGlzaGVkLiBgcGFnZWA6IGVtcHR5IGxpbmVzIHRvbywgZm9yIGEgcGFnZSB0aGF0IGlzIGJ1aWx0LCB3aGljaCBuYW1lcyBubyBsaW5lcyBvZiBpdHNcbiAqICAgc291cmNlcy5cbiAqIEByZXR1cm5zIHt7IGNvZGU6IHN0cmluZywgbWFwOiB7IHZlcnNpb246IDMsIHNvdXJjZXM6IHN0cmluZ1tdLCBzb3VyY2VzQ29udGVudDogc3RyaW5nW10sIG5hbWVzOiBzdHJpbmdbXSwgbWFwcGluZ3M6XG4gKiBzdHJpbmcgfSB9fVxuICogQHRocm93cyB7V2VzbEVycm9yfVxuICovXG5leHBvcnQgZnVuY3Rpb24gY29tcGlsZVdlc2wodGV4dCwgZmlsZSwgeyBzaHJpbmsgPSBmYWxzZSwgcGFnZSA9IGZhbHNlIH0gPSB7fSkge1xuICBjb25zdCBwYXJzZWQgPSBwYXJzZVdlc2wodGV4dCwgZmlsZSk7XG4gIGNvbnN0IHsgZm9sZGVyLCBzaG9ydCB9ID0gcGFja2FnZU9mKGZpbGUpO1xuICBjb25zdCBzb3VyY2UgPSBqb2luKGZvbGRlciwgJ3NyYycpO1xuICBjb25zdCBuYW1lcyA9IG5ldyBNYXAoKTtcbiAgY29uc3QgZGVwZW5kZW5jaWVzID0gbmV3IE1hcCgpO1xuICBjb25zdCBudW1iZXJzID0gbmV3IE1hcCgpO1xuICBjb25zdCB1c2VkID0gbmV3IFNldChbJ3dnc2xNb2R1bGUnXSk7XG4gIGxldCBpbXBvcnRzID0gJyc7XG4gIGZvciAoY29uc3QgZW50cnkgb2YgcGFyc2VkLmltcG9ydHMpIHtcbiAgICBpZiAoaXNIb3N0KGVudHJ5LnBhdGgpKSBjb250aW51ZTtcbiAgICBjb25zdCB7IGZpbGU6IHRhcmdldCwgd2VzbCB9ID0gcmVzb2x2ZU1vZHVsZShlbnRyeSwgZmlsZSwgc291cmNlKTtcbiAgICBjb25zdCBzcGVjaWZpZXIgPSBgLi8ke3JlbGF0aXZlKGRpcm5hbWUoZmlsZSksIHRhcmdldCkuc3BsaXQoc2VwKS5qb2luKCcvJyl9YFxuICAgICAgLnJlcGxhY2UoL15cXC5cXC9cXC5cXC5cXC8vLCAnLi4vJylcbiAgICAgIC5yZXBsYWNlKC9cXC50cyQvLCAnJyk7XG4gICAgaWYgKCF3ZXNsICYmIGlzTnVtYmVyKGVudHJ5Lm5hbWUpKSB7XG4gICAgICBpZiAobnVtYmVycy5oYXMoZW50cnkubmFtZSkpIGNvbnRpbnVlO1xuICAgICAgbnVtYmVycy5zZXQoZW50cnkubmFtZSwgYG51bWJlciR7bnVtYmVycy5zaXplfWApO1xuICAgICAgaW1wb3J0cyArPSBgaW1wb3J0IHsgJHtlbnRyeS5uYW1lfSBhcyAke251bWJlcnMuZ2V0KGVudHJ5Lm5hbWUpfSB9IGZyb20gJHtKU09OLnN0cmluZ2lmeShzcGVjaWZpZXIpfTtgO1xuICAgICAgY29udGludWU7XG4gICAgfVxuICAgIGNvbnN0IGtleSA9IHdlc2wgPyBzcGVjaWZpZXIgOiBgJHtzcGVjaWZpZXJ9ICR7ZW50cnkubmFtZX1gO1xuICAgIGxldCBuYW1lID0gbmFtZXMuZ2V0KGtleSk7XG4gICAgaWYgKG5hbWUgPT09IHVuZGVmaW5lZCkge1xuICAgICAgbmFtZXMuc2V0KGtleSwgKG5hbWUgPSBgbW9kdWxlJHtuYW1lcy5zaXplfWApKTtcbiAgICAgIGltcG9ydHMgKz0gYGltcG9ydCAke3dlc2wgPyBuYW1lIDogYHsgJHtlbnRyeS5uYW1lfSBhcyAke25hbWV9IH1gfSBmcm9tICR7SlNPTi5zdHJpbmdpZnkoc3BlY2lmaWVyKX07YDtcbiAgICB9XG4gICAgaWYgKGVudHJ5LmZsYWcgIT09IHVuZGVmaW5lZCkgdXNlZC5hZGQoJ2dhdGVkJyk7XG4gICAgY29uc3QgZGVwZW5kZW5jeSA9XG4gICAgICBlbnRyeS5mbGFnID09PSB1bmRlZmluZWQgPyBuYW1lIDogYC8qIEBfX1BVUkVfXyAqLyBnYXRlZCgke0pTT04uc3RyaW5naWZ5KGVudHJ5LmZsYWcpfSwgJHtuYW1lfSlgO1xuICAgIGRlcGVuZGVuY2llcy5zZXQoZGVwZW5kZW5jeSwgZGVwZW5kZW5jeSk7XG4gIH1cbiAgY29uc3QgdGl0bGUgPSBgJHtzaG9ydH0vJHtmaWxlXG4gICAgLnNwbGl0KC9bXFxcXC9dLylcbiAgICAuYXQoLTEpXG4gICAgLnJlcGxhY2UoL1xcLndlc2wkLywgJycpXG4gICAgLnJlcGxhY2VBbGwoJ18nLCAnLScpfWA7XG4gIGNvbnN0IGxpbmVzID0gZ2F0ZWRUZXh0KHRleHQsIHBhcnNlZCwgc2hyaW5rIHx8IHBhZ2UpO1xuICBjb25zdCB0ZW1wbGF0ZSA9IChwYWdlID8gbGluZXMucmVwbGFjZSgvXFxuXFxuKy9nLCAnXFxuJykudHJpbVN0YXJ0KCkgOiBsaW5lcylcbiAgICAucmVwbGFjZSgvW1xcXFxgXXxcXCQoPz1cXHspL2csICdcXFxcJCYnKVxuICAgIC5yZXBsYWNlKC9bQS1aYS16X11cXHcqL2csIChuYW1lKSA9PiAobnVtYmVycy5oYXMobmFtZSkgPyBgXFwkeyR7bnVtYmVycy5nZXQobmFtZSl9fXVgIDogbmFtZSkpO1xuICAvLyBBbGwgb24gdGhlIGZpcnN0IGxpbmUsIHNvIHRoYXQgZWFjaCBsaW5lIG9mIHRoZSByZXN1bHQgaXMgdGhhdCBvZiB0aGUgZmlsZS5cbiAgY29uc3QgY29kZSA9IGBpbXBvcnQgeyAke1suLi51c2VkXS5zb3J0KCkuam9pbignLCAnKX0gfSBmcm9tIFwiQGdsYW56L3dnc2wvbW9kdWxlXCI7JHtpbXBvcnRzfWV4cG9ydCBkZWZhdWx0IC8qIEBfX1BVUkVfXyAqLyB3Z3NsTW9kdWxlKCR7SlNPTi5zdHJpbmdpZnkodGl0bGUpfSwgXFxgJHt0ZW1wbGF0ZX1cXGAke2RlcGVuZGVuY2llcy5zaXplID4gMCA/IGAsIFske1suLi5kZXBlbmRlbmNpZXMudmFsdWVzKCldLmpvaW4oJywgJyl9XWAgOiAnJ30pO1xcbmA7XG4gIGNvbnN0IGNvbnN0YW50cyA9IHJlYWRDb25zdGFudHModGV4dCwgZmlsZSk7XG4gIGNvbnN0IG1hcHBpbmdzID0gYEFBQUEkeyc7QUFDQScucmVwZWF0KHRleHQuc3BsaXQoJ1xcbicpLmxlbmd0aCAtIDEpfWA7XG4gIHJldHVybiB7XG4gICAgY29kZTogY29uc3RhbnRzID8gY29kZSArIGV4cG9ydGVkQ29uc3RhbnRzKGNvbnN0YW50cykgOiBjb2RlLFxuICAgIG1hcDogeyB2ZXJzaW9uOiAzLCBzb3VyY2VzOiBbZmlsZS5zcGxpdCgvW1xcXFwvXS8pLmF0KC0xKV0sIHNvdXJjZXNDb250ZW50OiBbdGV4dF0sIG5hbWVzOiBbXSwgbWFwcGluZ3MgfSxcbiAgfTtcbn1cblxuLyoqIEZvciBlc2J1aWxkIGFuZCB0c3VwLiBAcGFyYW0ge3sgc2hyaW5rPzogYm9vbGVhbiwgcGFnZT86IGJvb2xlYW4gfX0gb3B0aW9ucyBBcyBmb3Ige0BsaW5rIGNvbXBpbGVXZXNsfS4gKi9cbmV4cG9ydCBjb25zdCB3ZXNsU291cmNlID0gKG9wdGlvbnMgPSB7fSkgPT4gKHtcbiAgbmFtZTogJ3dlc2wnLFxuICBzZXR1cChidWlsZCkge1xuICAgIGJ1aWxkLm9uTG9hZCh7IGZpbHRlcjogL1xcLndlc2wkLyB9LCAoeyBwYXRoIH0pID0+IHtcbiAgICAgIGNvbnN0IHsgY29kZSwgbWFwIH0gPSBjb21waWxlV2VzbChyZWFkRmlsZVN5bmMocGF0aCwgJ3V0ZjgnKSwgcGF0aCwgb3B0aW9ucyk7XG4gICAgICByZXR1cm4ge1xuICAgICAgICBjb250ZW50czogYCR7Y29kZX0vLyMgc291cmNlTWFwcGluZ1VSTD1kYXRhOmFwcGxpY2F0aW9uL2pzb247YmFzZTY0LCR7QnVmZmVyLmZyb20oSlNPTi5zdHJpbmdpZnkobWFwKSkudG9TdHJpbmcoJ2Jhc2U2NCcpfWAsXG4gICAgICAgIGxvYWRlcjogJ2pzJyxcbiAgICAgICAgcmVzb2x2ZURpcjogZGlybmFtZShwYXRoKSxcbiAgICAgIH07XG4gICAgfSk7XG4gIH0sXG59KTtcblxuLyoqIEZvciBWaXRlLCBWaXRlc3QgYW5kIFZpdGVQcmVzcy4gV2hhdCB0aGV5IGJ1aWxkIGFyZSBwYWdlcy4gKi9cbmV4cG9ydCBjb25zdCB3ZXNsTW9kdWxlcyA9ICgpID0+IHtcbiAgbGV0IHBhZ2UgPSBmYWxzZTtcbiAgcmV0dXJuIHtcbiAgICBuYW1lOiAnd2VzbCcsXG4gICAgZW5mb3JjZTogJ3ByZScsXG4gICAgY29uZmlnUmVzb2x2ZWQ6ICh7IGNvbW1hbmQgfSkgPT4gdm9pZCAocGFnZSA9IGNvbW1hbmQgPT09ICdidWlsZCcpLFxuICAgIHRyYW5zZm9ybTogKHRleHQsIGlkKSA9PiB7XG4gICAgICBpZiAoIWlkLmVuZHNXaXRoKCcud2VzbCcpKSByZXR1cm4gdW5kZWZpbmVkO1xuICAgICAgY29uc3QgeyBjb2RlLCBtYXAgfSA9IGNvbXBpbGVXZXNsKHRleHQsIGlkLCB7IHBhZ2UgfSk7XG4gICAgICByZXR1cm4geyBjb2RlLCBtYXA6IHBhZ2UgPyBudWxsIDogbWFwIH07XG4gICAgfSxcbiAgfTtcbn07XG4iLCAiY29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2Rpcm5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmVcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZmlsZW5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC1jb25zdGFudHMubWpzXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCA9IFwiZmlsZTovLy90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC1jb25zdGFudHMubWpzXCI7Ly8gQ29uc3RhbnRzIHRoYXQgc2hhZGVycyBhbmQgVHlwZVNjcmlwdCBzaGFyZSBhcmUgd3JpdHRlbiBvbmNlLCBpbiBhIFdFU0wgZmlsZSB0aGF0IGhvbGRzIG5vdGhpbmcgZWxzZTpcbi8vXG4vLyAgIC8vIFNhbXBsZXMgd2hvc2UgbWVhbiBpcyBvbmUgZW50cnkgb2YgdGhlIHN1bS5cbi8vICAgY29uc3QgRklMTV9DSFVOSyA9IDE2dTtcbi8vICAgY29uc3QgQkFORFMgPSBhcnJheTx2ZWMyZiwgMj4odmVjMmYoMC41LCAxLjApLCB2ZWMyZigxLjUsIDIuMCkpO1xuLy9cbi8vIEl0cyBtb2R1bGUgZXhwb3J0cyBlYWNoIG9mIHRoZW0gYnkgbmFtZTogYSBudW1iZXIgb3IgYm9vbGVhbiwgb3IgYW4gYXJyYXkgb2Ygc3VjaC4gYDxmaWxlPi53ZXNsLmQudHNgIGJlc2lkZSBpdFxuLy8gZGVjbGFyZXMgdGhlbSB0byBUeXBlU2NyaXB0LCB3aXRoIHRoZWlyIGNvbW1lbnRzOiBgbm9kZSB0b29scy9waXBlbGluZS93ZXNsLWNvbnN0YW50cy5tanNgIHdyaXRlcyBpdC5cbmltcG9ydCB7IGV4aXN0c1N5bmMsIHJlYWRGaWxlU3luYywgcmVhZGRpclN5bmMsIHdyaXRlRmlsZVN5bmMgfSBmcm9tICdub2RlOmZzJztcbmltcG9ydCB7IGpvaW4sIHJlbGF0aXZlIH0gZnJvbSAnbm9kZTpwYXRoJztcbmltcG9ydCB7IGZpbGVVUkxUb1BhdGggfSBmcm9tICdub2RlOnVybCc7XG5pbXBvcnQgeyBXZXNsRXJyb3IsIHRva2VuaXplIH0gZnJvbSAnLi93ZXNsLXRva2Vucy5tanMnO1xuXG5jb25zdCBTQ0FMQVIgPSAvXig/OmkzMnx1MzJ8ZjMyfGYxNnxib29sKSQvO1xuY29uc3QgVkVDVE9SID0gL152ZWMoWzIzNF0pKFtpdWZoXT8pJC87XG5jb25zdCBOVU1CRVIgPSAvXig/OjBbeFhdW1xcZGEtZkEtRl0rW2l1XT98KD86XFxkK1xcLj9cXGQqfFxcLlxcZCspKD86W2VFXVstK10/XFxkKyk/W2l1ZmhdPykkLztcblxuLyoqIFRoZSB2YWx1ZSBvZiBhIGxpdGVyYWwgbnVtYmVyIGFzIFdHU0wgcmVhZHMgaXQuICovXG5mdW5jdGlvbiBudW1iZXJPZih0ZXh0KSB7XG4gIGNvbnN0IGhleCA9IC9eMFt4WF0vLnRlc3QodGV4dCk7XG4gIHJldHVybiBOdW1iZXIodGV4dC5yZXBsYWNlKGhleCA/IC9baXVdJC8gOiAvW2l1ZmhdJC8sICcnKSk7XG59XG5cbi8qKlxuICogVGhlIGNvbnN0YW50cyBvZiBhIGZpbGUgdGhhdCBkZWNsYXJlcyBub3RoaW5nIGVsc2UsIG9yIGB1bmRlZmluZWRgIGZvciBhbnkgb3RoZXIgZmlsZS4gQSBmaWxlIG5hbWVkIGBjb25zdGFudHNgIG11c3RcbiAqIGJlIG9uZS5cbiAqXG4gKiBAcGFyYW0ge3N0cmluZ30gdGV4dFxuICogQHBhcmFtIHtzdHJpbmd9IGZpbGUgRm9yIG1lc3NhZ2VzLlxuICogQHJldHVybnMge3sgbmFtZTogc3RyaW5nLCB2YWx1ZTogbnVtYmVyIHwgYm9vbGVhbiB8IHJlYWRvbmx5IHVua25vd25bXSwgdHlwZTogc3RyaW5nLCBkb2M6IHN0cmluZywgbGluZTogbnVtYmVyIH1bXSB8XG4gKiAgIHVuZGVmaW5lZH0gYHR5cGVgIGlzIFR5cGVTY3JpcHQncywgYGRvY2AgdGhlIGxpbmVzIG9mIHRoZSBjb21tZW50IHJpZ2h0IGJlZm9yZSBpdC5cbiAqIEB0aHJvd3Mge1dlc2xFcnJvcn1cbiAqL1xuZXhwb3J0IGZ1bmN0aW9uIHJlYWRDb25zdGFudHModGV4dCwgZmlsZSA9ICdjb25zdGFudHMud2VzbCcpIHtcbiAgY29uc3QgbGluZU9mID0gKGF0KSA9PiB0ZXh0LnNsaWNlKDAsIGF0KS5zcGxpdCgnXFxuJykubGVuZ3RoO1xuICBjb25zdCBmYWlsID0gKGF0LCBtZXNzYWdlKSA9PiB7XG4gICAgdGhyb3cgbmV3IFdlc2xFcnJvcihgJHtmaWxlfToke2xpbmVPZihhdCl9OiAke21lc3NhZ2V9LmApO1xuICB9O1xuICBjb25zdCB7IHRva2VucywgY29tbWVudHMgfSA9IHRva2VuaXplKHRleHQsIGZhaWwpO1xuICBjb25zdCBkZW1hbmRlZCA9IC8oXnxbXFxcXC9dKWNvbnN0YW50c1xcLndlc2wkLy50ZXN0KGZpbGUpO1xuICBpZiAoIWRlbWFuZGVkICYmICFob2xkc09ubHlDb25zdGFudHModG9rZW5zKSkgcmV0dXJuIHVuZGVmaW5lZDtcbiAgbGV0IG5leHQgPSAwO1xuICBjb25zdCBwZWVrID0gKCkgPT4gdG9rZW5zW25leHRdPy50ZXh0O1xuICBjb25zdCBoZXJlID0gKCkgPT4gdG9rZW5zW25leHRdPy5mcm9tID8/IHRleHQubGVuZ3RoO1xuICBjb25zdCB0YWtlID0gKGV4cGVjdGVkKSA9PiB7XG4gICAgY29uc3QgdG9rZW4gPSB0b2tlbnNbbmV4dF07XG4gICAgaWYgKHRva2VuID09PSB1bmRlZmluZWQgfHwgKGV4cGVjdGVkICE9PSB1bmRlZmluZWQgJiYgdG9rZW4udGV4dCAhPT0gZXhwZWN0ZWQpKVxuICAgICAgcmV0dXJuIGZhaWwoaGVyZSgpLCBgXCIke3Rva2VuPy50ZXh0ID8/ICd0aGUgZW5kJ31cIiBzdGFuZHMgd2hlcmUgXCIke2V4cGVjdGVkID8/ICdtb3JlJ31cIiBpcyBleHBlY3RlZGApO1xuICAgIG5leHQrKztcbiAgICByZXR1cm4gdG9rZW47XG4gIH07XG5cbiAgLyoqIFdoYXQgYSB0eXBlJ3MgbmFtZSBhbmQgaXRzIGJyYWNrZXRzIHNheTogaG93IG1hbnkgZWxlbWVudHMsIGFuZCB3aGF0IGVhY2ggaXMuICovXG4gIGNvbnN0IHR5cGUgPSAoKSA9PiB7XG4gICAgY29uc3QgYXQgPSBoZXJlKCk7XG4gICAgY29uc3QgbmFtZSA9IHRha2UoKS50ZXh0O1xuICAgIGlmIChTQ0FMQVIudGVzdChuYW1lKSkgcmV0dXJuIHsga2luZDogJ3NjYWxhcicsIHNjYWxhcjogbmFtZSB9O1xuICAgIGNvbnN0IHZlY3RvciA9IFZFQ1RPUi5leGVjKG5hbWUpO1xuICAgIGlmICh2ZWN0b3IpIHtcbiAgICAgIGxldCBzY2FsYXIgPSB7IGk6ICdpMzInLCB1OiAndTMyJywgZjogJ2YzMicsIGg6ICdmMTYnIH1bdmVjdG9yWzJdXTtcbiAgICAgIGlmIChzY2FsYXIgPT09IHVuZGVmaW5lZCAmJiBwZWVrKCkgPT09ICc8Jykge1xuICAgICAgICB0YWtlKCc8Jyk7XG4gICAgICAgIGNvbnN0IGlubmVyID0gdHlwZSgpO1xuICAgICAgICBpZiAoaW5uZXIua2luZCAhPT0gJ3NjYWxhcicpIGZhaWwoYXQsICdhIHZlY3RvciBob2xkcyBudW1iZXJzJyk7XG4gICAgICAgIHNjYWxhciA9IGlubmVyLnNjYWxhcjtcbiAgICAgICAgdGFrZSgnPicpO1xuICAgICAgfVxuICAgICAgcmV0dXJuIHsga2luZDogJ3ZlY3RvcicsIGNvdW50OiBOdW1iZXIodmVjdG9yWzFdKSwgc2NhbGFyIH07XG4gICAgfVxuICAgIGlmIChuYW1lID09PSAnYXJyYXknKSB7XG4gICAgICBpZiAocGVlaygpICE9PSAnPCcpIHJldHVybiB7IGtpbmQ6ICdhcnJheScgfTtcbiAgICAgIHRha2UoJzwnKTtcbiAgICAgIGNvbnN0IGVsZW1lbnQgPSB0eXBlKCk7XG4gICAgICBsZXQgY291bnQ7XG4gICAgICBpZiAocGVlaygpID09PSAnLCcpIHtcbiAgICAgICAgdGFrZSgnLCcpO1xuICAgICAgICBjb25zdCBsZW5ndGggPSB0YWtlKCk7XG4gICAgICAgIGlmICghL15cXGQrdT8kLy50ZXN0KGxlbmd0aC50ZXh0KSkgZmFpbChsZW5ndGguZnJvbSwgJ3RoZSBsZW5ndGggb2YgYW4gYXJyYXkgaXMgYSBsaXRlcmFsJyk7XG4gICAgICAgIGNvdW50ID0gbnVtYmVyT2YobGVuZ3RoLnRleHQpO1xuICAgICAgICBpZiAocGVlaygpID09PSAnLCcpIHRha2UoJywnKTtcbiAgICAgIH1cbiAgICAgIHRha2UoJz4nKTtcbiAgICAgIHJldHVybiB7IGtpbmQ6ICdhcnJheScsIGVsZW1lbnQsIGNvdW50IH07XG4gICAgfVxuICAgIHJldHVybiBmYWlsKGF0LCBgXCIke25hbWV9XCIgaXMgbm8gbnVtYmVyLCBib29sZWFuLCB2ZWN0b3Igb3IgYXJyYXk6IGEgdGFibGUgb2YgY29uc3RhbnRzIGhvbGRzIGxpdGVyYWxzYCk7XG4gIH07XG5cbiAgY29uc3QgY2hlY2sgPSAoYXQsIHZhbHVlLCB3cml0dGVuLCBzY2FsYXIpID0+IHtcbiAgICBjb25zdCBzdWZmaXggPSAvXjBbeFhdLy50ZXN0KHdyaXR0ZW4pID8gL1tpdV0kLy5leGVjKHdyaXR0ZW4pPy5bMF0gOiAvW2l1ZmhdJC8uZXhlYyh3cml0dGVuKT8uWzBdO1xuICAgIGNvbnN0IG93biA9IHsgaTogJ2kzMicsIHU6ICd1MzInLCBmOiAnZjMyJywgaDogJ2YxNicgfVtzdWZmaXhdO1xuICAgIGNvbnN0IGlzID0gb3duID8/IHNjYWxhcjtcbiAgICBpZiAob3duICE9PSB1bmRlZmluZWQgJiYgc2NhbGFyICE9PSB1bmRlZmluZWQgJiYgb3duICE9PSBzY2FsYXIpIGZhaWwoYXQsIGAke3dyaXR0ZW59IGlzIG5vICR7c2NhbGFyfWApO1xuICAgIGlmICgoaXMgPT09ICdpMzInIHx8IGlzID09PSAndTMyJykgJiYgIU51bWJlci5pc0ludGVnZXIodmFsdWUpKSBmYWlsKGF0LCBgJHt3cml0dGVufSBpcyBubyAke2lzfWApO1xuICAgIGlmIChpcyA9PT0gJ2Jvb2wnKSBmYWlsKGF0LCBgJHt3cml0dGVufSBpcyBubyBib29sYCk7XG4gICAgY29uc3QgW2xvdywgaGlnaF0gPVxuICAgICAgaXMgPT09ICd1MzInID8gWzAsIDIgKiogMzIgLSAxXSA6IGlzID09PSAnaTMyJyA/IFstKDIgKiogMzEpLCAyICoqIDMxIC0gMV0gOiBbLTMuNDAyODIzNWUzOCwgMy40MDI4MjM1ZTM4XTtcbiAgICBpZiAodmFsdWUgPCBsb3cgfHwgdmFsdWUgPiBoaWdoKSBmYWlsKGF0LCBgJHt3cml0dGVufSBpcyBvdXQgb2YgcmFuZ2VgKTtcbiAgfTtcblxuICAvKiogQHJldHVybnMge3sgdmFsdWU6IHVua25vd24sIHR5cGU6IHN0cmluZyB9fSAqL1xuICBjb25zdCBleHByZXNzaW9uID0gKHdhbnRlZCkgPT4ge1xuICAgIGNvbnN0IGF0ID0gaGVyZSgpO1xuICAgIGNvbnN0IHRva2VuID0gcGVlaygpO1xuICAgIGlmICh0b2tlbiA9PT0gJ3RydWUnIHx8IHRva2VuID09PSAnZmFsc2UnKSB7XG4gICAgICBpZiAod2FudGVkICE9PSB1bmRlZmluZWQgJiYgd2FudGVkLnNjYWxhciAhPT0gJ2Jvb2wnKSBmYWlsKGF0LCBgJHt0b2tlbn0gc3RhbmRzIHdoZXJlIGEgbnVtYmVyIGlzIGV4cGVjdGVkYCk7XG4gICAgICB0YWtlKCk7XG4gICAgICByZXR1cm4geyB2YWx1ZTogdG9rZW4gPT09ICd0cnVlJywgdHlwZTogJ2Jvb2xlYW4nIH07XG4gICAgfVxuICAgIGlmICh0b2tlbiA9PT0gJy0nIHx8IE5VTUJFUi50ZXN0KHRva2VuID8/ICcnKSkge1xuICAgICAgaWYgKHdhbnRlZCAhPT0gdW5kZWZpbmVkICYmIHdhbnRlZC5raW5kICE9PSAnc2NhbGFyJykgZmFpbChhdCwgJ2EgbnVtYmVyIHN0YW5kcyB3aGVyZSBzZXZlcmFsIGFyZSBleHBlY3RlZCcpO1xuICAgICAgaWYgKHRva2VuID09PSAnLScpIHRha2UoKTtcbiAgICAgIGNvbnN0IHsgdGV4dDogd3JpdHRlbiwgZnJvbSB9ID0gdGFrZSgpO1xuICAgICAgaWYgKCFOVU1CRVIudGVzdCh3cml0dGVuKSkgZmFpbChmcm9tLCBgXCIke3dyaXR0ZW59XCIgaXMgbm8gbGl0ZXJhbGApO1xuICAgICAgY29uc3QgdmFsdWUgPSB0b2tlbiA9PT0gJy0nID8gLW51bWJlck9mKHdyaXR0ZW4pIDogbnVtYmVyT2Yod3JpdHRlbik7XG4gICAgICBjaGVjayhmcm9tLCB2YWx1ZSwgd3JpdHRlbiwgd2FudGVkPy5zY2FsYXIpO1xuICAgICAgcmV0dXJuIHsgdmFsdWUsIHR5cGU6ICdudW1iZXInIH07XG4gICAgfVxuICAgIGNvbnN0IGZvdW5kID0gdHlwZSgpO1xuICAgIGlmIChmb3VuZC5raW5kID09PSAnc2NhbGFyJykgZmFpbChhdCwgJ2EgdGFibGUgb2YgY29uc3RhbnRzIGNvbnZlcnRzIG5vIHZhbHVlczogd3JpdGUgdGhlIGxpdGVyYWwnKTtcbiAgICBpZiAod2FudGVkICE9PSB1bmRlZmluZWQgJiYgd2FudGVkLmtpbmQgIT09IGZvdW5kLmtpbmQpIGZhaWwoYXQsICd0aGUgdmFsdWUgaXMgb2YgYW5vdGhlciB0eXBlJyk7XG4gICAgdGFrZSgnKCcpO1xuICAgIGNvbnN0IG9mID0gZm91bmQua2luZCA9PT0gJ3ZlY3RvcicgPyB7IGtpbmQ6ICdzY2FsYXInLCBzY2FsYXI6IGZvdW5kLnNjYWxhciB9IDogZm91bmQuZWxlbWVudDtcbiAgICBjb25zdCBlbGVtZW50cyA9IFtdO1xuICAgIHdoaWxlIChwZWVrKCkgIT09ICcpJykge1xuICAgICAgZWxlbWVudHMucHVzaChleHByZXNzaW9uKG9mKSk7XG4gICAgICBpZiAocGVlaygpICE9PSAnKScpIHRha2UoJywnKTtcbiAgICB9XG4gICAgdGFrZSgnKScpO1xuICAgIGNvbnN0IGNvdW50ID0gZm91bmQuY291bnQgPz8gKHdhbnRlZD8ua2luZCA9PT0gJ2FycmF5JyA/IHdhbnRlZC5jb3VudCA6IHVuZGVmaW5lZCkgPz8gZWxlbWVudHMubGVuZ3RoO1xuICAgIGlmIChlbGVtZW50cy5sZW5ndGggPT09IDAgfHwgZWxlbWVudHMubGVuZ3RoICE9PSBjb3VudClcbiAgICAgIGZhaWwoYXQsIGAke2VsZW1lbnRzLmxlbmd0aH0gdmFsdWVzIHN0YW5kIHdoZXJlICR7Y291bnQgfHwgJ3NvbWUnfSBhcmUgZXhwZWN0ZWRgKTtcbiAgICBjb25zdCBlbGVtZW50ID0gZWxlbWVudHNbMF0udHlwZTtcbiAgICBpZiAoZWxlbWVudHMuc29tZSgoeyB0eXBlOiBvdGhlciB9KSA9PiBvdGhlciAhPT0gZWxlbWVudCkpIGZhaWwoYXQsICd0aGUgZWxlbWVudHMgYXJlIG9mIHNldmVyYWwgdHlwZXMnKTtcbiAgICByZXR1cm4ge1xuICAgICAgdmFsdWU6IGVsZW1lbnRzLm1hcCgoeyB2YWx1ZSB9KSA9PiB2YWx1ZSksXG4gICAgICB0eXBlOlxuICAgICAgICBmb3VuZC5raW5kID09PSAndmVjdG9yJ1xuICAgICAgICAgID8gYHJlYWRvbmx5IFske2VsZW1lbnRzLm1hcCgoKSA9PiBlbGVtZW50KS5qb2luKCcsICcpfV1gXG4gICAgICAgICAgOiBgcmVhZG9ubHkgJHsvXlxcdyskLy50ZXN0KGVsZW1lbnQpID8gZWxlbWVudCA6IGAoJHtlbGVtZW50fSlgfVtdYCxcbiAgICB9O1xuICB9O1xuXG4gIGNvbnN0IGNvbnN0YW50cyA9IFtdO1xuICB3aGlsZSAobmV4dCA8IHRva2Vucy5sZW5ndGgpIHtcbiAgICBjb25zdCBhdCA9IGhlcmUoKTtcbiAgICBpZiAocGVlaygpICE9PSAnY29uc3QnKVxuICAgICAgZmFpbChhdCwgYFwiJHtwZWVrKCl9XCIgc3RhbmRzIGluIGEgdGFibGUgb2YgY29uc3RhbnRzLCB3aGljaCBob2xkcyBcImNvbnN0IE5BTUUgPSBsaXRlcmFsO1wiIGFsb25lYCk7XG4gICAgdGFrZSgpO1xuICAgIGNvbnN0IG5hbWUgPSB0YWtlKCk7XG4gICAgaWYgKGNvbnN0YW50cy5zb21lKChvdGhlcikgPT4gb3RoZXIubmFtZSA9PT0gbmFtZS50ZXh0KSkgZmFpbChuYW1lLmZyb20sIGAke25hbWUudGV4dH0gaXMgZGVjbGFyZWQgdHdpY2VgKTtcbiAgICBsZXQgZGVjbGFyZWQ7XG4gICAgaWYgKHBlZWsoKSA9PT0gJzonKSB7XG4gICAgICB0YWtlKCk7XG4gICAgICBkZWNsYXJlZCA9IHR5cGUoKTtcbiAgICB9XG4gICAgdGFrZSgnPScpO1xuICAgIGNvbnN0IGZvdW5kID0gZXhwcmVzc2lvbihkZWNsYXJlZCk7XG4gICAgaWYgKHBlZWsoKSAhPT0gJzsnKSBmYWlsKGhlcmUoKSwgYFwiJHtwZWVrKCkgPz8gJ3RoZSBlbmQnfVwiIGZvbGxvd3MgdGhlIGxpdGVyYWw6IHdyaXRlIHRoZSB2YWx1ZSBpdHNlbGZgKTtcbiAgICB0YWtlKCc7Jyk7XG4gICAgY29uc3RhbnRzLnB1c2goeyBuYW1lOiBuYW1lLnRleHQsIC4uLmZvdW5kLCBkb2M6IGNvbW1lbnRCZWZvcmUodGV4dCwgY29tbWVudHMsIGF0KSwgbGluZTogbGluZU9mKGF0KSB9KTtcbiAgfVxuICBpZiAoY29uc3RhbnRzLmxlbmd0aCA9PT0gMCkgZmFpbCgwLCAnaXQgaG9sZHMgbm8gY29uc3RhbnQnKTtcbiAgcmV0dXJuIGNvbnN0YW50cztcbn1cblxuLyoqIFdoZXRoZXIgYWxsIGRlY2xhcmF0aW9ucyBhcmUgYGNvbnN0YCwgd2l0aG91dCBpbXBvcnRzLCBnYXRlcyBvciBhdHRyaWJ1dGVzLiAqL1xuZnVuY3Rpb24gaG9sZHNPbmx5Q29uc3RhbnRzKHRva2Vucykge1xuICBpZiAodG9rZW5zLmxlbmd0aCA9PT0gMCkgcmV0dXJuIGZhbHNlO1xuICBsZXQgYmVnaW5zID0gdHJ1ZTtcbiAgZm9yIChjb25zdCB7IHRleHQgfSBvZiB0b2tlbnMpIHtcbiAgICBpZiAoYmVnaW5zICYmIHRleHQgIT09ICdjb25zdCcpIHJldHVybiBmYWxzZTtcbiAgICBiZWdpbnMgPSB0ZXh0ID09PSAnOyc7XG4gIH1cbiAgcmV0dXJuIHRydWU7XG59XG5cbi8qKiBUaGUgbGluZXMgb2YgYC8vYCBkaXJlY3RseSBhYm92ZSBhIHBsYWNlLCB3aXRob3V0IHRoZWlyIHNsYXNoZXMuICovXG5mdW5jdGlvbiBjb21tZW50QmVmb3JlKHRleHQsIGNvbW1lbnRzLCBhdCkge1xuICBjb25zdCBsaW5lcyA9IFtdO1xuICBsZXQgYmVsb3cgPSB0ZXh0Lmxhc3RJbmRleE9mKCdcXG4nLCBhdCAtIDEpICsgMTtcbiAgZm9yIChjb25zdCB7IGZyb20sIHRvIH0gb2YgWy4uLmNvbW1lbnRzXS5yZXZlcnNlKCkpIHtcbiAgICBpZiAoZnJvbSA+PSBhdCkgY29udGludWU7XG4gICAgY29uc3QgYmVnaW4gPSB0ZXh0Lmxhc3RJbmRleE9mKCdcXG4nLCBmcm9tIC0gMSkgKyAxO1xuICAgIGlmICh0byArIDEgIT09IGJlbG93IHx8IHRleHQuc2xpY2UoYmVnaW4sIGZyb20pLnRyaW0oKSAhPT0gJycgfHwgIXRleHQuc3RhcnRzV2l0aCgnLy8nLCBmcm9tKSkgYnJlYWs7XG4gICAgbGluZXMudW5zaGlmdCh0ZXh0LnNsaWNlKGZyb20gKyAyLCB0bykudHJpbSgpKTtcbiAgICBiZWxvdyA9IGJlZ2luO1xuICB9XG4gIHJldHVybiBsaW5lcy5qb2luKCdcXG4nKTtcbn1cblxuLyoqIFRoZSBleHBvcnRzIG9mIGEgbW9kdWxlIHdpdGggdGhlc2UgY29uc3RhbnRzLiAqL1xuZXhwb3J0IGNvbnN0IGV4cG9ydGVkQ29uc3RhbnRzID0gKGNvbnN0YW50cykgPT5cbiAgYGV4cG9ydCBjb25zdCAke2NvbnN0YW50cy5tYXAoKHsgbmFtZSwgdmFsdWUgfSkgPT4gYCR7bmFtZX0gPSAke0pTT04uc3RyaW5naWZ5KHZhbHVlKX1gKS5qb2luKCcsICcpfTtcXG5gO1xuXG4vKipcbiAqIFdoYXQgZGVjbGFyZXMgYSB0YWJsZSBvZiBjb25zdGFudHMgdG8gVHlwZVNjcmlwdC5cbiAqIEB0aHJvd3Mge1dlc2xFcnJvcn1cbiAqL1xuZXhwb3J0IGZ1bmN0aW9uIGRlY2xhcmVDb25zdGFudHModGV4dCwgZmlsZSkge1xuICBjb25zdCBsaW5lcyA9IFtcImltcG9ydCB0eXBlIHsgV2dzbE1vZHVsZSB9IGZyb20gJ0BnbGFuei93Z3NsJztcIiwgJyddO1xuICBmb3IgKGNvbnN0IHsgbmFtZSwgdHlwZSwgZG9jIH0gb2YgcmVhZENvbnN0YW50cyh0ZXh0LCBmaWxlKSkge1xuICAgIGNvbnN0IGRvY3MgPSBkb2Muc3BsaXQoJ1xcbicpO1xuICAgIGlmIChkb2MgIT09ICcnICYmIGRvY3MubGVuZ3RoID09PSAxKSBsaW5lcy5wdXNoKGAvKiogJHtkb2N9ICovYCk7XG4gICAgZWxzZSBpZiAoZG9jICE9PSAnJykgbGluZXMucHVzaCgnLyoqJywgLi4uZG9jcy5tYXAoKGxpbmUpID0+IGAgKiAke2xpbmV9YC50cmltRW5kKCkpLCAnICovJyk7XG4gICAgbGluZXMucHVzaChgZXhwb3J0IGNvbnN0ICR7bmFtZX06ICR7dHlwZX07YCk7XG4gIH1cbiAgcmV0dXJuIGAke2xpbmVzLmpvaW4oJ1xcbicpfVxcblxcbmRlY2xhcmUgY29uc3QgbW9kdWxlOiBXZ3NsTW9kdWxlO1xcbmV4cG9ydCBkZWZhdWx0IG1vZHVsZTtcXG5gO1xufVxuXG4vKiogVGhlIGZpbGUgdGhhdCBkZWNsYXJlcyBhIHRhYmxlIHRvIFR5cGVTY3JpcHQuICovXG5leHBvcnQgY29uc3QgZGVjbGFyYXRpb25GaWxlID0gKGZpbGUpID0+IGAke2ZpbGV9LmQudHNgO1xuXG4vKiogQWxsIHRhYmxlcyBvZiBjb25zdGFudHMgYmVsb3cgdGhlIHNvdXJjZXMgb2YgdGhlIHBhY2thZ2VzLiBAcmV0dXJucyB7c3RyaW5nW119ICovXG5leHBvcnQgZnVuY3Rpb24gY29uc3RhbnRGaWxlcyhyb290KSB7XG4gIHJldHVybiByZWFkZGlyU3luYyhqb2luKHJvb3QsICdwYWNrYWdlcycpKVxuICAgIC5tYXAoKG5hbWUpID0+IGpvaW4ocm9vdCwgJ3BhY2thZ2VzJywgbmFtZSwgJ3NyYycpKVxuICAgIC5maWx0ZXIoKGZvbGRlcikgPT4gZXhpc3RzU3luYyhmb2xkZXIpKVxuICAgIC5mbGF0TWFwKChmb2xkZXIpID0+IHJlYWRkaXJTeW5jKGZvbGRlciwgeyByZWN1cnNpdmU6IHRydWUsIGVuY29kaW5nOiAndXRmOCcgfSkubWFwKChwYXRoKSA9PiBqb2luKGZvbGRlciwgcGF0aCkpKVxuICAgIC5maWx0ZXIoKGZpbGUpID0+IGZpbGUuZW5kc1dpdGgoJy53ZXNsJykgJiYgcmVhZENvbnN0YW50cyhyZWFkRmlsZVN5bmMoZmlsZSwgJ3V0ZjgnKSwgZmlsZSkgIT09IHVuZGVmaW5lZClcbiAgICAuc29ydCgpO1xufVxuXG5pZiAocHJvY2Vzcy5hcmd2WzFdID09PSBmaWxlVVJMVG9QYXRoKGltcG9ydC5tZXRhLnVybCkpIHtcbiAgY29uc3Qgcm9vdCA9IGpvaW4oaW1wb3J0Lm1ldGEuZGlybmFtZSwgJy4uLy4uJyk7XG4gIGZvciAoY29uc3QgZmlsZSBvZiBjb25zdGFudEZpbGVzKHJvb3QpKSB7XG4gICAgd3JpdGVGaWxlU3luYyhkZWNsYXJhdGlvbkZpbGUoZmlsZSksIGRlY2xhcmVDb25zdGFudHMocmVhZEZpbGVTeW5jKGZpbGUsICd1dGY4JyksIGZpbGUpKTtcbiAgICBwcm9jZXNzLnN0ZG91dC53cml0ZShgJHtyZWxhdGl2ZShyb290LCBkZWNsYXJhdGlvbkZpbGUoZmlsZSkpfVxcbmApO1xuICB9XG59XG4iLCAiY29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2Rpcm5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmVcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZmlsZW5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC10b2tlbnMubWpzXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCA9IFwiZmlsZTovLy90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC10b2tlbnMubWpzXCI7Ly8gVGhlIHRva2VucyBvZiBhIFdFU0wgZmlsZS5cblxuLyoqIEEgYC53ZXNsYCBmaWxlIHRoYXQgY2Fubm90IGJlIHR1cm5lZCBpbnRvIGEgbW9kdWxlOiB3aGF0IGlzIHdyb25nLCB3aXRoIGZpbGUgYW5kIGxpbmUuICovXG5leHBvcnQgY2xhc3MgV2VzbEVycm9yIGV4dGVuZHMgRXJyb3Ige1xuICBuYW1lID0gJ1dlc2xFcnJvcic7XG59XG5cbmNvbnN0IFRPS0VOID0gL1xcL1xcL1teXFxuXSp8XFwvXFwqfFtBLVphLXpfXVxcdyp8KD86XFxkfFxcLlxcZCkoPzpbZUVwUF1bLStdfFtcXHcuXSkqfDo6fCYmfFxcfFxcfHxcXFMvZztcblxuLyoqXG4gKiBUb2tlbnMgd2l0aCB0aGVpciBwbGFjZXMuIENvbW1lbnRzIGFyZSBsaXN0ZWQgYXBhcnQuXG4gKlxuICogQHBhcmFtIHtzdHJpbmd9IHRleHRcbiAqIEBwYXJhbSB7KGF0OiBudW1iZXIsIG1lc3NhZ2U6IHN0cmluZykgPT4gbmV2ZXJ9IGZhaWxcbiAqL1xuZXhwb3J0IGZ1bmN0aW9uIHRva2VuaXplKHRleHQsIGZhaWwpIHtcbiAgY29uc3QgdG9rZW5zID0gW107XG4gIGNvbnN0IGNvbW1lbnRzID0gW107XG4gIFRPS0VOLmxhc3RJbmRleCA9IDA7XG4gIGZvciAobGV0IG1hdGNoOyAobWF0Y2ggPSBUT0tFTi5leGVjKHRleHQpKTspIHtcbiAgICBjb25zdCBmcm9tID0gbWF0Y2guaW5kZXg7XG4gICAgaWYgKG1hdGNoWzBdID09PSAnLyonKSB7XG4gICAgICAvLyBUaGV5IG5lc3QuXG4gICAgICBsZXQgZGVwdGggPSAwO1xuICAgICAgY29uc3QgZWRnZSA9IC9cXC9cXCp8XFwqXFwvL2c7XG4gICAgICBlZGdlLmxhc3RJbmRleCA9IGZyb207XG4gICAgICBmb3IgKGxldCBmb3VuZDsgKGZvdW5kID0gZWRnZS5leGVjKHRleHQpKTspIHtcbiAgICAgICAgZGVwdGggKz0gZm91bmRbMF0gPT09ICcvKicgPyAxIDogLTE7XG4gICAgICAgIGlmIChkZXB0aCA9PT0gMCkgYnJlYWs7XG4gICAgICB9XG4gICAgICBpZiAoZGVwdGggIT09IDApIGZhaWwoZnJvbSwgJ2EgYmxvY2sgY29tbWVudCBuZXZlciBlbmRzJyk7XG4gICAgICBjb21tZW50cy5wdXNoKHsgZnJvbSwgdG86IGVkZ2UubGFzdEluZGV4IH0pO1xuICAgICAgVE9LRU4ubGFzdEluZGV4ID0gZWRnZS5sYXN0SW5kZXg7XG4gICAgfSBlbHNlIGlmIChtYXRjaFswXS5zdGFydHNXaXRoKCcvLycpKSBjb21tZW50cy5wdXNoKHsgZnJvbSwgdG86IFRPS0VOLmxhc3RJbmRleCB9KTtcbiAgICBlbHNlIHRva2Vucy5wdXNoKHsgdGV4dDogbWF0Y2hbMF0sIGZyb20sIHRvOiBUT0tFTi5sYXN0SW5kZXggfSk7XG4gIH1cbiAgcmV0dXJuIHsgdG9rZW5zLCBjb21tZW50cyB9O1xufVxuIiwgImNvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9kaXJuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ZpbGVuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wtbmFtZXMubWpzXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCA9IFwiZmlsZTovLy90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC1uYW1lcy5tanNcIjsvLyBTaG9ydCBuYW1lcyBmb3Igd2hhdCBpcyBsb2NhbCB0byB0aGUgZnVuY3Rpb25zIG9mIGEgc2hhZGVyLCBmb3Igd2hhdCBpcyBwdWJsaXNoZWQ6IHBhcmFtZXRlcnMsIHZhcmlhYmxlcyBhbmRcbi8vIGNvbnN0YW50cyBpbnNpZGUgb2YgZnVuY3Rpb25zLiBOYW1lcyB0aGF0IG90aGVyIG1vZHVsZXMsIGhvc3RzIG9yIHVzZXJzJyBvd24gV0dTTCBtYXkgdXNlIHN0YXk6IHRob3NlIG9mIGZ1bmN0aW9ucyxcbi8vIHN0cnVjdHMsIG1lbWJlcnMsIGNvbnN0YW50cyBvZiBhIG1vZHVsZS5cblxuLyoqIE5hbWVzIHRoYXQgYXJlIG5ldmVyIGdpdmVuOiB0aGUga2V5d29yZHMgb2YgV0dTTCB3aXRoIGF0IG1vc3QgdHdvIGxldHRlcnMsIGFuZCBgX2AuICovXG5jb25zdCBLRVlXT1JEUyA9IG5ldyBTZXQoWydfJywgJ2RvJywgJ2ZuJywgJ2lmJywgJ2FzJywgJ2lzJywgJ29mJ10pO1xuXG4vKiogYSwgYiwgXHUyMDI2IHosIEEsIFx1MjAyNiBaLCBhYSwgYWIsIFx1MjAyNiAqL1xuZnVuY3Rpb24qIHNob3J0TmFtZXMoKSB7XG4gIGNvbnN0IGxldHRlcnMgPSAnYWJjZGVmZ2hpamtsbW5vcHFyc3R1dnd4eXpBQkNERUZHSElKS0xNTk9QUVJTVFVWV1hZWic7XG4gIGZvciAoY29uc3QgbGV0dGVyIG9mIGxldHRlcnMpIHlpZWxkIGxldHRlcjtcbiAgZm9yIChjb25zdCBmaXJzdCBvZiBsZXR0ZXJzKSBmb3IgKGNvbnN0IHNlY29uZCBvZiBsZXR0ZXJzKSB5aWVsZCBmaXJzdCArIHNlY29uZDtcbn1cblxuLyoqXG4gKiBAcGFyYW0ge3sgdGV4dDogc3RyaW5nLCBmcm9tOiBudW1iZXIsIHRvOiBudW1iZXIgfVtdfSB0b2tlbnMgT2YgYSBXRVNMIGZpbGUsIHdpdGhvdXQgY29tbWVudHMuXG4gKiBAcmV0dXJucyB7eyBmcm9tOiBudW1iZXIsIHRvOiBudW1iZXIsIHRleHQ6IHN0cmluZyB9W119IFJlcGxhY2VtZW50cyBvZiBuYW1lcywgZWFjaCBsaW5lIGluIGl0cyBwbGFjZS5cbiAqL1xuZXhwb3J0IGZ1bmN0aW9uIHNob3J0ZW5Mb2NhbHModG9rZW5zKSB7XG4gIGNvbnN0IGVkaXRzID0gW107XG4gIGNvbnN0IGlkZW50aWZpZXJzID0gbmV3IFNldCh0b2tlbnMubWFwKCh7IHRleHQgfSkgPT4gdGV4dCkpO1xuICBjb25zdCB0ZXh0ID0gKGkpID0+IHRva2Vuc1tpXT8udGV4dDtcbiAgbGV0IGkgPSAwO1xuXG4gIC8qKiBUaGUgcGxhY2UgYWZ0ZXIgdGhlIGJyYWNrZXQgdGhhdCBvcGVucyBhdCBgYXRgLiAqL1xuICBjb25zdCBhZnRlckJyYWNrZXQgPSAoYXQpID0+IHtcbiAgICBsZXQgZGVwdGggPSAwO1xuICAgIGRvIHtcbiAgICAgIGlmICgnKFt7Jy5pbmNsdWRlcyh0ZXh0KGF0KSkpIGRlcHRoKys7XG4gICAgICBpZiAoJyldfScuaW5jbHVkZXModGV4dChhdCkpKSBkZXB0aC0tO1xuICAgICAgYXQrKztcbiAgICB9IHdoaWxlIChkZXB0aCA+IDAgJiYgYXQgPCB0b2tlbnMubGVuZ3RoKTtcbiAgICByZXR1cm4gYXQ7XG4gIH07XG5cbiAgY29uc3QgZnVuY3Rpb25BdCA9ICgpID0+IHtcbiAgICBjb25zdCBuYW1lcyA9IG5ldyBNYXAoKTtcbiAgICBjb25zdCBjYW5kaWRhdGVzID0gc2hvcnROYW1lcygpO1xuICAgIGNvbnN0IHNob3J0Rm9yID0gKG5hbWUpID0+IHtcbiAgICAgIGxldCBzaG9ydCA9IG5hbWVzLmdldChuYW1lKTtcbiAgICAgIHdoaWxlIChzaG9ydCA9PT0gdW5kZWZpbmVkKSB7XG4gICAgICAgIGNvbnN0IHsgdmFsdWUgfSA9IGNhbmRpZGF0ZXMubmV4dCgpO1xuICAgICAgICBpZiAodmFsdWUgPT09IHVuZGVmaW5lZCkgc2hvcnQgPSBuYW1lO1xuICAgICAgICBlbHNlIGlmICghaWRlbnRpZmllcnMuaGFzKHZhbHVlKSAmJiAhS0VZV09SRFMuaGFzKHZhbHVlKSkgc2hvcnQgPSB2YWx1ZTtcbiAgICAgIH1cbiAgICAgIG5hbWVzLnNldChuYW1lLCBzaG9ydCk7XG4gICAgICByZXR1cm4gc2hvcnQ7XG4gICAgfTtcbiAgICAvLyBOYW1lcyBieSB0aGUgYmxvY2sgdGhhdCBkZWNsYXJlcyB0aGVtLCB0aGUgaW5uZXJtb3N0IGxhc3QuXG4gICAgY29uc3Qgc2NvcGVzID0gW25ldyBTZXQoKV07XG4gICAgY29uc3QgZGVjbGFyZSA9IChuYW1lKSA9PiBzY29wZXMuYXQoLTEpLmFkZChuYW1lKTtcbiAgICBjb25zdCByZXBsYWNlID0gKGF0KSA9PiB7XG4gICAgICBjb25zdCB7IHRleHQ6IG5hbWUsIGZyb20sIHRvIH0gPSB0b2tlbnNbYXRdO1xuICAgICAgY29uc3Qgc2hvcnQgPSBzaG9ydEZvcihuYW1lKTtcbiAgICAgIGlmIChzaG9ydC5sZW5ndGggPCBuYW1lLmxlbmd0aCkgZWRpdHMucHVzaCh7IGZyb20sIHRvLCB0ZXh0OiBzaG9ydCB9KTtcbiAgICB9O1xuICAgIC8qKiBBbiBhdHRyaWJ1dGUgd2l0aCBpdHMgYXJndW1lbnRzLCB3aGljaCBhcmUgbm8gbmFtZXMgb2Ygb3Vycy4gKi9cbiAgICBjb25zdCBza2lwQXR0cmlidXRlID0gKCkgPT4ge1xuICAgICAgaSArPSAyO1xuICAgICAgaWYgKHRleHQoaSkgPT09ICcoJykgaSA9IGFmdGVyQnJhY2tldChpKTtcbiAgICB9O1xuXG4gICAgaSArPSAyO1xuICAgIC8vIFBhcmFtZXRlcnM6IGEgbmFtZSBiZWZvcmUgYSBjb2xvbiwgb3V0c2lkZSBvZiB0eXBlcy5cbiAgICBmb3IgKGxldCBkZXB0aCA9IDA7IDspIHtcbiAgICAgIGNvbnN0IHRva2VuID0gdGV4dChpKTtcbiAgICAgIGlmICh0b2tlbiA9PT0gJ0AnKSB7XG4gICAgICAgIHNraXBBdHRyaWJ1dGUoKTtcbiAgICAgICAgY29udGludWU7XG4gICAgICB9XG4gICAgICBpZiAodG9rZW4gPT09ICcoJyB8fCB0b2tlbiA9PT0gJzwnKSBkZXB0aCsrO1xuICAgICAgaWYgKHRva2VuID09PSAnKScgfHwgdG9rZW4gPT09ICc+JykgZGVwdGgtLTtcbiAgICAgIGlmIChkZXB0aCA9PT0gMSAmJiB0ZXh0KGkgKyAxKSA9PT0gJzonICYmIC9eW0EtWmEtel9dLy50ZXN0KHRva2VuKSkge1xuICAgICAgICBkZWNsYXJlKHRva2VuKTtcbiAgICAgICAgcmVwbGFjZShpKTtcbiAgICAgIH1cbiAgICAgIGkrKztcbiAgICAgIGlmIChkZXB0aCA9PT0gMCkgYnJlYWs7XG4gICAgfVxuICAgIHdoaWxlICh0ZXh0KGkpICE9PSAneycpIGkgKz0gMTtcblxuICAgIC8vIFdoYXQgYSBzdGF0ZW1lbnQgZGVjbGFyZXMgaXMga25vd24gYWZ0ZXIgaXQ6IGBsZXQgeCA9IGYoeCk7YCByZWFkcyBhbm90aGVyIHguXG4gICAgbGV0IHBlbmRpbmcgPSBbXTtcbiAgICAvLyBEZXB0aHMgb2YgYnJhY2tldHMgYXQgd2hpY2ggdGhlIGhlYWRzIG9mIGxvb3BzIGJlZ2FuOiB0aGVpciB2YXJpYWJsZXMgbGl2ZSBhcyBsb25nIGFzIHRoZSBibG9jayBhZnRlciBpdC5cbiAgICBjb25zdCBoZWFkcyA9IFtdO1xuICAgIGxldCByb3VuZCA9IDA7XG4gICAgY29uc3Qgc2V0dGxlID0gKCkgPT4ge1xuICAgICAgcGVuZGluZy5mb3JFYWNoKGRlY2xhcmUpO1xuICAgICAgcGVuZGluZyA9IFtdO1xuICAgIH07XG4gICAgbGV0IGRlcHRoID0gMDtcbiAgICBkbyB7XG4gICAgICBjb25zdCB0b2tlbiA9IHRleHQoaSk7XG4gICAgICBpZiAodG9rZW4gPT09ICdAJykge1xuICAgICAgICBza2lwQXR0cmlidXRlKCk7XG4gICAgICAgIGNvbnRpbnVlO1xuICAgICAgfVxuICAgICAgaWYgKHRva2VuID09PSAnZm9yJykge1xuICAgICAgICBzY29wZXMucHVzaChuZXcgU2V0KCkpO1xuICAgICAgICBoZWFkcy5wdXNoKHsgZGVwdGgsIHJvdW5kIH0pO1xuICAgICAgfSBlbHNlIGlmICh0b2tlbiA9PT0gJygnKSByb3VuZCsrO1xuICAgICAgZWxzZSBpZiAodG9rZW4gPT09ICcpJykgcm91bmQtLTtcbiAgICAgIGVsc2UgaWYgKHRva2VuID09PSAnOycpIHNldHRsZSgpO1xuICAgICAgZWxzZSBpZiAodG9rZW4gPT09ICd7Jykge1xuICAgICAgICBzZXR0bGUoKTtcbiAgICAgICAgZGVwdGgrKztcbiAgICAgICAgc2NvcGVzLnB1c2gobmV3IFNldCgpKTtcbiAgICAgIH0gZWxzZSBpZiAodG9rZW4gPT09ICd9Jykge1xuICAgICAgICBzZXR0bGUoKTtcbiAgICAgICAgZGVwdGgtLTtcbiAgICAgICAgc2NvcGVzLnBvcCgpO1xuICAgICAgICBpZiAoaGVhZHMuYXQoLTEpPy5kZXB0aCA9PT0gZGVwdGggJiYgaGVhZHMuYXQoLTEpLnJvdW5kID09PSByb3VuZCkge1xuICAgICAgICAgIGhlYWRzLnBvcCgpO1xuICAgICAgICAgIHNjb3Blcy5wb3AoKTtcbiAgICAgICAgfVxuICAgICAgfSBlbHNlIGlmICgvXihsZXR8dmFyfGNvbnN0KSQvLnRlc3QodG9rZW4pKSB7XG4gICAgICAgIGxldCBhdCA9IGkgKyAxO1xuICAgICAgICBpZiAodGV4dChhdCkgPT09ICc8Jykgd2hpbGUgKHRleHQoYXQrKykgIT09ICc+Jyk7XG4gICAgICAgIHBlbmRpbmcucHVzaCh0ZXh0KGF0KSk7XG4gICAgICAgIC8vIFVwIHRvIHRoZSBuYW1lOyBpdCBpcyByZXBsYWNlZCBoZXJlLCBzaW5jZSBpdCBpcyBub3Qga25vd24geWV0LlxuICAgICAgICByZXBsYWNlKGF0KTtcbiAgICAgICAgaSA9IGF0O1xuICAgICAgfSBlbHNlIGlmICgvXltBLVphLXpfXS8udGVzdCh0b2tlbikgJiYgdGV4dChpIC0gMSkgIT09ICcuJyAmJiBzY29wZXMuc29tZSgoc2NvcGUpID0+IHNjb3BlLmhhcyh0b2tlbikpKVxuICAgICAgICByZXBsYWNlKGkpO1xuICAgICAgaSsrO1xuICAgIH0gd2hpbGUgKGRlcHRoID4gMCk7XG4gIH07XG5cbiAgd2hpbGUgKGkgPCB0b2tlbnMubGVuZ3RoKSB7XG4gICAgaWYgKHRleHQoaSkgPT09ICdmbicpIGZ1bmN0aW9uQXQoKTtcbiAgICBlbHNlIGkrKztcbiAgfVxuICByZXR1cm4gZWRpdHM7XG59XG4iXSwKICAibWFwcGluZ3MiOiAiO0FBRUEsU0FBUyxvQkFBb0I7OztBQ2U3QixJQUFNLFFBQWdFO0FBQUEsRUFDcEUsS0FBSztBQUFBLEVBQ0wsUUFBUTtBQUFBLEVBQ1IsWUFBUztBQUFBLEVBQ1QsU0FBSTtBQUNOO0FBRUEsSUFBTSxTQUFTLENBQUMsVUFDZCxVQUFVLFdBQVcsV0FBTSxVQUFVLFlBQVksaUJBQU8sT0FBTyxLQUFLLEVBQUUsUUFBUSxLQUFLLFFBQUc7QUFDeEYsSUFBTSxXQUFXLENBQUMsVUFDaEIsUUFBUSxHQUFHLE9BQU8sTUFBTSxDQUFDLENBQUMsQ0FBQyxXQUFNLE9BQU8sTUFBTSxDQUFDLENBQUMsQ0FBQyxLQUFLO0FBRXhELFNBQVMsUUFBUSxPQUFnRDtBQUMvRCxNQUFJLFVBQVUsS0FBTSxRQUFPO0FBQzNCLE1BQUksT0FBTyxVQUFVLFVBQVcsUUFBTyxRQUFRLFFBQVE7QUFDdkQsU0FBTyxPQUFPLFVBQVUsV0FBVyxPQUFPLEtBQUssSUFBSSxNQUFNLElBQUksTUFBTSxFQUFFLEtBQUssSUFBSTtBQUNoRjtBQUdPLFNBQVMsY0FDZCxPQUNBLFFBQytDO0FBQy9DLFFBQU0sU0FBd0QsQ0FBQztBQUMvRCxhQUFXLEVBQUUsTUFBTSxPQUFPLE1BQU0sU0FBUyxPQUFPLE9BQU8sV0FBVyxNQUFNLFlBQVksSUFBSSxLQUFLLE9BQU8sT0FBTyxLQUFLLEdBQUc7QUFDakgsVUFBTSxPQUFPLFNBQVMsU0FBUztBQUMvQixLQUFDLE9BQU8sS0FBSyxNQUFNLENBQUMsR0FBRyxLQUFLO0FBQUEsTUFDMUI7QUFBQSxNQUNBO0FBQUEsTUFDQTtBQUFBLE1BQ0EsU0FBUyxRQUFRLEtBQUs7QUFBQSxNQUN0QixPQUFPLFNBQVMsS0FBSztBQUFBLE1BQ3JCLFdBQVcsU0FBUyxTQUFTLEtBQUssSUFBSSxLQUFLO0FBQUEsTUFDM0MsTUFBTSxRQUFRLE1BQU0sSUFBSSxJQUFJO0FBQUEsTUFDNUI7QUFBQSxNQUNBLE1BQU0sT0FBTyxTQUFTLElBQUk7QUFBQSxNQUMxQixLQUFLLElBQUksV0FBVyxLQUFLLEVBQUU7QUFBQSxJQUM3QixDQUFDO0FBQUEsRUFDSDtBQUNBLFNBQU87QUFDVDs7O0FDekQwUCxTQUFTLGlCQUFBQSxzQkFBcUI7QUFDeFIsU0FBUyxhQUFhOzs7QUNNdEIsU0FBUyxjQUFBQyxhQUFZLGdCQUFBQyxxQkFBb0I7QUFDekMsU0FBUyxTQUFTLFFBQUFDLE9BQU0sWUFBQUMsV0FBVSxTQUFTLFdBQVc7OztBQ0F0RCxTQUFTLFlBQVksY0FBYyxhQUFhLHFCQUFxQjtBQUNyRSxTQUFTLE1BQU0sZ0JBQWdCO0FBQy9CLFNBQVMscUJBQXFCOzs7QUNQdkIsSUFBTSxZQUFOLGNBQXdCLE1BQU07QUFBQSxFQUNuQyxPQUFPO0FBQ1Q7QUFFQSxJQUFNLFFBQVE7QUFRUCxTQUFTLFNBQVMsTUFBTSxNQUFNO0FBQ25DLFFBQU0sU0FBUyxDQUFDO0FBQ2hCLFFBQU0sV0FBVyxDQUFDO0FBQ2xCLFFBQU0sWUFBWTtBQUNsQixXQUFTLE9BQVEsUUFBUSxNQUFNLEtBQUssSUFBSSxLQUFLO0FBQzNDLFVBQU0sT0FBTyxNQUFNO0FBQ25CLFFBQUksTUFBTSxDQUFDLE1BQU0sTUFBTTtBQUVyQixVQUFJLFFBQVE7QUFDWixZQUFNLE9BQU87QUFDYixXQUFLLFlBQVk7QUFDakIsZUFBUyxPQUFRLFFBQVEsS0FBSyxLQUFLLElBQUksS0FBSztBQUMxQyxpQkFBUyxNQUFNLENBQUMsTUFBTSxPQUFPLElBQUk7QUFDakMsWUFBSSxVQUFVLEVBQUc7QUFBQSxNQUNuQjtBQUNBLFVBQUksVUFBVSxFQUFHLE1BQUssTUFBTSw0QkFBNEI7QUFDeEQsZUFBUyxLQUFLLEVBQUUsTUFBTSxJQUFJLEtBQUssVUFBVSxDQUFDO0FBQzFDLFlBQU0sWUFBWSxLQUFLO0FBQUEsSUFDekIsV0FBVyxNQUFNLENBQUMsRUFBRSxXQUFXLElBQUksRUFBRyxVQUFTLEtBQUssRUFBRSxNQUFNLElBQUksTUFBTSxVQUFVLENBQUM7QUFBQSxRQUM1RSxRQUFPLEtBQUssRUFBRSxNQUFNLE1BQU0sQ0FBQyxHQUFHLE1BQU0sSUFBSSxNQUFNLFVBQVUsQ0FBQztBQUFBLEVBQ2hFO0FBQ0EsU0FBTyxFQUFFLFFBQVEsU0FBUztBQUM1Qjs7O0FEckNBLElBQU0sbUNBQW1DO0FBQXFILElBQU0sMkNBQTJDO0FBYS9NLElBQU0sU0FBUztBQUNmLElBQU0sU0FBUztBQUNmLElBQU0sU0FBUztBQUdmLFNBQVMsU0FBUyxNQUFNO0FBQ3RCLFFBQU0sTUFBTSxTQUFTLEtBQUssSUFBSTtBQUM5QixTQUFPLE9BQU8sS0FBSyxRQUFRLE1BQU0sVUFBVSxXQUFXLEVBQUUsQ0FBQztBQUMzRDtBQVlPLFNBQVMsY0FBYyxNQUFNLE9BQU8sa0JBQWtCO0FBQzNELFFBQU0sU0FBUyxDQUFDLE9BQU8sS0FBSyxNQUFNLEdBQUcsRUFBRSxFQUFFLE1BQU0sSUFBSSxFQUFFO0FBQ3JELFFBQU0sT0FBTyxDQUFDLElBQUksWUFBWTtBQUM1QixVQUFNLElBQUksVUFBVSxHQUFHLElBQUksSUFBSSxPQUFPLEVBQUUsQ0FBQyxLQUFLLE9BQU8sR0FBRztBQUFBLEVBQzFEO0FBQ0EsUUFBTSxFQUFFLFFBQVEsU0FBUyxJQUFJLFNBQVMsTUFBTSxJQUFJO0FBQ2hELFFBQU0sV0FBVyw0QkFBNEIsS0FBSyxJQUFJO0FBQ3RELE1BQUksQ0FBQyxZQUFZLENBQUMsbUJBQW1CLE1BQU0sRUFBRyxRQUFPO0FBQ3JELE1BQUksT0FBTztBQUNYLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHO0FBQ2pDLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHLFFBQVEsS0FBSztBQUM5QyxRQUFNLE9BQU8sQ0FBQyxhQUFhO0FBQ3pCLFVBQU0sUUFBUSxPQUFPLElBQUk7QUFDekIsUUFBSSxVQUFVLFVBQWMsYUFBYSxVQUFhLE1BQU0sU0FBUztBQUNuRSxhQUFPLEtBQUssS0FBSyxHQUFHLElBQUksT0FBTyxRQUFRLFNBQVMsbUJBQW1CLFlBQVksTUFBTSxlQUFlO0FBQ3RHO0FBQ0EsV0FBTztBQUFBLEVBQ1Q7QUFHQSxRQUFNLE9BQU8sTUFBTTtBQUNqQixVQUFNLEtBQUssS0FBSztBQUNoQixVQUFNLE9BQU8sS0FBSyxFQUFFO0FBQ3BCLFFBQUksT0FBTyxLQUFLLElBQUksRUFBRyxRQUFPLEVBQUUsTUFBTSxVQUFVLFFBQVEsS0FBSztBQUM3RCxVQUFNLFNBQVMsT0FBTyxLQUFLLElBQUk7QUFDL0IsUUFBSSxRQUFRO0FBQ1YsVUFBSSxTQUFTLEVBQUUsR0FBRyxPQUFPLEdBQUcsT0FBTyxHQUFHLE9BQU8sR0FBRyxNQUFNLEVBQUUsT0FBTyxDQUFDLENBQUM7QUFDakUsVUFBSSxXQUFXLFVBQWEsS0FBSyxNQUFNLEtBQUs7QUFDMUMsYUFBSyxHQUFHO0FBQ1IsY0FBTSxRQUFRLEtBQUs7QUFDbkIsWUFBSSxNQUFNLFNBQVMsU0FBVSxNQUFLLElBQUksd0JBQXdCO0FBQzlELGlCQUFTLE1BQU07QUFDZixhQUFLLEdBQUc7QUFBQSxNQUNWO0FBQ0EsYUFBTyxFQUFFLE1BQU0sVUFBVSxPQUFPLE9BQU8sT0FBTyxDQUFDLENBQUMsR0FBRyxPQUFPO0FBQUEsSUFDNUQ7QUFDQSxRQUFJLFNBQVMsU0FBUztBQUNwQixVQUFJLEtBQUssTUFBTSxJQUFLLFFBQU8sRUFBRSxNQUFNLFFBQVE7QUFDM0MsV0FBSyxHQUFHO0FBQ1IsWUFBTSxVQUFVLEtBQUs7QUFDckIsVUFBSTtBQUNKLFVBQUksS0FBSyxNQUFNLEtBQUs7QUFDbEIsYUFBSyxHQUFHO0FBQ1IsY0FBTSxTQUFTLEtBQUs7QUFDcEIsWUFBSSxDQUFDLFVBQVUsS0FBSyxPQUFPLElBQUksRUFBRyxNQUFLLE9BQU8sTUFBTSxxQ0FBcUM7QUFDekYsZ0JBQVEsU0FBUyxPQUFPLElBQUk7QUFDNUIsWUFBSSxLQUFLLE1BQU0sSUFBSyxNQUFLLEdBQUc7QUFBQSxNQUM5QjtBQUNBLFdBQUssR0FBRztBQUNSLGFBQU8sRUFBRSxNQUFNLFNBQVMsU0FBUyxNQUFNO0FBQUEsSUFDekM7QUFDQSxXQUFPLEtBQUssSUFBSSxJQUFJLElBQUksK0VBQStFO0FBQUEsRUFDekc7QUFFQSxRQUFNLFFBQVEsQ0FBQyxJQUFJLE9BQU8sU0FBUyxXQUFXO0FBQzVDLFVBQU0sU0FBUyxTQUFTLEtBQUssT0FBTyxJQUFJLFFBQVEsS0FBSyxPQUFPLElBQUksQ0FBQyxJQUFJLFVBQVUsS0FBSyxPQUFPLElBQUksQ0FBQztBQUNoRyxVQUFNLE1BQU0sRUFBRSxHQUFHLE9BQU8sR0FBRyxPQUFPLEdBQUcsT0FBTyxHQUFHLE1BQU0sRUFBRSxNQUFNO0FBQzdELFVBQU0sS0FBSyxPQUFPO0FBQ2xCLFFBQUksUUFBUSxVQUFhLFdBQVcsVUFBYSxRQUFRLE9BQVEsTUFBSyxJQUFJLEdBQUcsT0FBTyxVQUFVLE1BQU0sRUFBRTtBQUN0RyxTQUFLLE9BQU8sU0FBUyxPQUFPLFVBQVUsQ0FBQyxPQUFPLFVBQVUsS0FBSyxFQUFHLE1BQUssSUFBSSxHQUFHLE9BQU8sVUFBVSxFQUFFLEVBQUU7QUFDakcsUUFBSSxPQUFPLE9BQVEsTUFBSyxJQUFJLEdBQUcsT0FBTyxhQUFhO0FBQ25ELFVBQU0sQ0FBQyxLQUFLLElBQUksSUFDZCxPQUFPLFFBQVEsQ0FBQyxHQUFHLEtBQUssS0FBSyxDQUFDLElBQUksT0FBTyxRQUFRLENBQUMsRUFBRSxLQUFLLEtBQUssS0FBSyxLQUFLLENBQUMsSUFBSSxDQUFDLGNBQWUsV0FBWTtBQUMzRyxRQUFJLFFBQVEsT0FBTyxRQUFRLEtBQU0sTUFBSyxJQUFJLEdBQUcsT0FBTyxrQkFBa0I7QUFBQSxFQUN4RTtBQUdBLFFBQU0sYUFBYSxDQUFDLFdBQVc7QUFDN0IsVUFBTSxLQUFLLEtBQUs7QUFDaEIsVUFBTSxRQUFRLEtBQUs7QUFDbkIsUUFBSSxVQUFVLFVBQVUsVUFBVSxTQUFTO0FBQ3pDLFVBQUksV0FBVyxVQUFhLE9BQU8sV0FBVyxPQUFRLE1BQUssSUFBSSxHQUFHLEtBQUssb0NBQW9DO0FBQzNHLFdBQUs7QUFDTCxhQUFPLEVBQUUsT0FBTyxVQUFVLFFBQVEsTUFBTSxVQUFVO0FBQUEsSUFDcEQ7QUFDQSxRQUFJLFVBQVUsT0FBTyxPQUFPLEtBQUssU0FBUyxFQUFFLEdBQUc7QUFDN0MsVUFBSSxXQUFXLFVBQWEsT0FBTyxTQUFTLFNBQVUsTUFBSyxJQUFJLDRDQUE0QztBQUMzRyxVQUFJLFVBQVUsSUFBSyxNQUFLO0FBQ3hCLFlBQU0sRUFBRSxNQUFNLFNBQVMsS0FBSyxJQUFJLEtBQUs7QUFDckMsVUFBSSxDQUFDLE9BQU8sS0FBSyxPQUFPLEVBQUcsTUFBSyxNQUFNLElBQUksT0FBTyxpQkFBaUI7QUFDbEUsWUFBTSxRQUFRLFVBQVUsTUFBTSxDQUFDLFNBQVMsT0FBTyxJQUFJLFNBQVMsT0FBTztBQUNuRSxZQUFNLE1BQU0sT0FBTyxTQUFTLFFBQVEsTUFBTTtBQUMxQyxhQUFPLEVBQUUsT0FBTyxNQUFNLFNBQVM7QUFBQSxJQUNqQztBQUNBLFVBQU0sUUFBUSxLQUFLO0FBQ25CLFFBQUksTUFBTSxTQUFTLFNBQVUsTUFBSyxJQUFJLDREQUE0RDtBQUNsRyxRQUFJLFdBQVcsVUFBYSxPQUFPLFNBQVMsTUFBTSxLQUFNLE1BQUssSUFBSSw4QkFBOEI7QUFDL0YsU0FBSyxHQUFHO0FBQ1IsVUFBTSxLQUFLLE1BQU0sU0FBUyxXQUFXLEVBQUUsTUFBTSxVQUFVLFFBQVEsTUFBTSxPQUFPLElBQUksTUFBTTtBQUN0RixVQUFNLFdBQVcsQ0FBQztBQUNsQixXQUFPLEtBQUssTUFBTSxLQUFLO0FBQ3JCLGVBQVMsS0FBSyxXQUFXLEVBQUUsQ0FBQztBQUM1QixVQUFJLEtBQUssTUFBTSxJQUFLLE1BQUssR0FBRztBQUFBLElBQzlCO0FBQ0EsU0FBSyxHQUFHO0FBQ1IsVUFBTSxRQUFRLE1BQU0sVUFBVSxRQUFRLFNBQVMsVUFBVSxPQUFPLFFBQVEsV0FBYyxTQUFTO0FBQy9GLFFBQUksU0FBUyxXQUFXLEtBQUssU0FBUyxXQUFXO0FBQy9DLFdBQUssSUFBSSxHQUFHLFNBQVMsTUFBTSx1QkFBdUIsU0FBUyxNQUFNLGVBQWU7QUFDbEYsVUFBTSxVQUFVLFNBQVMsQ0FBQyxFQUFFO0FBQzVCLFFBQUksU0FBUyxLQUFLLENBQUMsRUFBRSxNQUFNLE1BQU0sTUFBTSxVQUFVLE9BQU8sRUFBRyxNQUFLLElBQUksbUNBQW1DO0FBQ3ZHLFdBQU87QUFBQSxNQUNMLE9BQU8sU0FBUyxJQUFJLENBQUMsRUFBRSxNQUFNLE1BQU0sS0FBSztBQUFBLE1BQ3hDLE1BQ0UsTUFBTSxTQUFTLFdBQ1gsYUFBYSxTQUFTLElBQUksTUFBTSxPQUFPLEVBQUUsS0FBSyxJQUFJLENBQUMsTUFDbkQsWUFBWSxRQUFRLEtBQUssT0FBTyxJQUFJLFVBQVUsSUFBSSxPQUFPLEdBQUc7QUFBQSxJQUNwRTtBQUFBLEVBQ0Y7QUFFQSxRQUFNLFlBQVksQ0FBQztBQUNuQixTQUFPLE9BQU8sT0FBTyxRQUFRO0FBQzNCLFVBQU0sS0FBSyxLQUFLO0FBQ2hCLFFBQUksS0FBSyxNQUFNO0FBQ2IsV0FBSyxJQUFJLElBQUksS0FBSyxDQUFDLDZFQUE2RTtBQUNsRyxTQUFLO0FBQ0wsVUFBTSxPQUFPLEtBQUs7QUFDbEIsUUFBSSxVQUFVLEtBQUssQ0FBQyxVQUFVLE1BQU0sU0FBUyxLQUFLLElBQUksRUFBRyxNQUFLLEtBQUssTUFBTSxHQUFHLEtBQUssSUFBSSxvQkFBb0I7QUFDekcsUUFBSTtBQUNKLFFBQUksS0FBSyxNQUFNLEtBQUs7QUFDbEIsV0FBSztBQUNMLGlCQUFXLEtBQUs7QUFBQSxJQUNsQjtBQUNBLFNBQUssR0FBRztBQUNSLFVBQU0sUUFBUSxXQUFXLFFBQVE7QUFDakMsUUFBSSxLQUFLLE1BQU0sSUFBSyxNQUFLLEtBQUssR0FBRyxJQUFJLEtBQUssS0FBSyxTQUFTLCtDQUErQztBQUN2RyxTQUFLLEdBQUc7QUFDUixjQUFVLEtBQUssRUFBRSxNQUFNLEtBQUssTUFBTSxHQUFHLE9BQU8sS0FBSyxjQUFjLE1BQU0sVUFBVSxFQUFFLEdBQUcsTUFBTSxPQUFPLEVBQUUsRUFBRSxDQUFDO0FBQUEsRUFDeEc7QUFDQSxNQUFJLFVBQVUsV0FBVyxFQUFHLE1BQUssR0FBRyxzQkFBc0I7QUFDMUQsU0FBTztBQUNUO0FBR0EsU0FBUyxtQkFBbUIsUUFBUTtBQUNsQyxNQUFJLE9BQU8sV0FBVyxFQUFHLFFBQU87QUFDaEMsTUFBSSxTQUFTO0FBQ2IsYUFBVyxFQUFFLEtBQUssS0FBSyxRQUFRO0FBQzdCLFFBQUksVUFBVSxTQUFTLFFBQVMsUUFBTztBQUN2QyxhQUFTLFNBQVM7QUFBQSxFQUNwQjtBQUNBLFNBQU87QUFDVDtBQUdBLFNBQVMsY0FBYyxNQUFNLFVBQVUsSUFBSTtBQUN6QyxRQUFNLFFBQVEsQ0FBQztBQUNmLE1BQUksUUFBUSxLQUFLLFlBQVksTUFBTSxLQUFLLENBQUMsSUFBSTtBQUM3QyxhQUFXLEVBQUUsTUFBTSxHQUFHLEtBQUssQ0FBQyxHQUFHLFFBQVEsRUFBRSxRQUFRLEdBQUc7QUFDbEQsUUFBSSxRQUFRLEdBQUk7QUFDaEIsVUFBTSxRQUFRLEtBQUssWUFBWSxNQUFNLE9BQU8sQ0FBQyxJQUFJO0FBQ2pELFFBQUksS0FBSyxNQUFNLFNBQVMsS0FBSyxNQUFNLE9BQU8sSUFBSSxFQUFFLEtBQUssTUFBTSxNQUFNLENBQUMsS0FBSyxXQUFXLE1BQU0sSUFBSSxFQUFHO0FBQy9GLFVBQU0sUUFBUSxLQUFLLE1BQU0sT0FBTyxHQUFHLEVBQUUsRUFBRSxLQUFLLENBQUM7QUFDN0MsWUFBUTtBQUFBLEVBQ1Y7QUFDQSxTQUFPLE1BQU0sS0FBSyxJQUFJO0FBQ3hCO0FBR08sSUFBTSxvQkFBb0IsQ0FBQyxjQUNoQyxnQkFBZ0IsVUFBVSxJQUFJLENBQUMsRUFBRSxNQUFNLE1BQU0sTUFBTSxHQUFHLElBQUksTUFBTSxLQUFLLFVBQVUsS0FBSyxDQUFDLEVBQUUsRUFBRSxLQUFLLElBQUksQ0FBQztBQUFBO0FBTTlGLFNBQVMsaUJBQWlCLE1BQU0sTUFBTTtBQUMzQyxRQUFNLFFBQVEsQ0FBQyxrREFBa0QsRUFBRTtBQUNuRSxhQUFXLEVBQUUsTUFBTSxNQUFNLElBQUksS0FBSyxjQUFjLE1BQU0sSUFBSSxHQUFHO0FBQzNELFVBQU0sT0FBTyxJQUFJLE1BQU0sSUFBSTtBQUMzQixRQUFJLFFBQVEsTUFBTSxLQUFLLFdBQVcsRUFBRyxPQUFNLEtBQUssT0FBTyxHQUFHLEtBQUs7QUFBQSxhQUN0RCxRQUFRLEdBQUksT0FBTSxLQUFLLE9BQU8sR0FBRyxLQUFLLElBQUksQ0FBQyxTQUFTLE1BQU0sSUFBSSxHQUFHLFFBQVEsQ0FBQyxHQUFHLEtBQUs7QUFDM0YsVUFBTSxLQUFLLGdCQUFnQixJQUFJLEtBQUssSUFBSSxHQUFHO0FBQUEsRUFDN0M7QUFDQSxTQUFPLEdBQUcsTUFBTSxLQUFLLElBQUksQ0FBQztBQUFBO0FBQUE7QUFBQTtBQUFBO0FBQzVCO0FBR08sSUFBTSxrQkFBa0IsQ0FBQyxTQUFTLEdBQUcsSUFBSTtBQUd6QyxTQUFTLGNBQWMsTUFBTTtBQUNsQyxTQUFPLFlBQVksS0FBSyxNQUFNLFVBQVUsQ0FBQyxFQUN0QyxJQUFJLENBQUMsU0FBUyxLQUFLLE1BQU0sWUFBWSxNQUFNLEtBQUssQ0FBQyxFQUNqRCxPQUFPLENBQUMsV0FBVyxXQUFXLE1BQU0sQ0FBQyxFQUNyQyxRQUFRLENBQUMsV0FBVyxZQUFZLFFBQVEsRUFBRSxXQUFXLE1BQU0sVUFBVSxPQUFPLENBQUMsRUFBRSxJQUFJLENBQUMsU0FBUyxLQUFLLFFBQVEsSUFBSSxDQUFDLENBQUMsRUFDaEgsT0FBTyxDQUFDLFNBQVMsS0FBSyxTQUFTLE9BQU8sS0FBSyxjQUFjLGFBQWEsTUFBTSxNQUFNLEdBQUcsSUFBSSxNQUFNLE1BQVMsRUFDeEcsS0FBSztBQUNWO0FBRUEsSUFBSSxRQUFRLEtBQUssQ0FBQyxNQUFNLGNBQWMsd0NBQWUsR0FBRztBQUN0RCxRQUFNLE9BQU8sS0FBSyxrQ0FBcUIsT0FBTztBQUM5QyxhQUFXLFFBQVEsY0FBYyxJQUFJLEdBQUc7QUFDdEMsa0JBQWMsZ0JBQWdCLElBQUksR0FBRyxpQkFBaUIsYUFBYSxNQUFNLE1BQU0sR0FBRyxJQUFJLENBQUM7QUFDdkYsWUFBUSxPQUFPLE1BQU0sR0FBRyxTQUFTLE1BQU0sZ0JBQWdCLElBQUksQ0FBQyxDQUFDO0FBQUEsQ0FBSTtBQUFBLEVBQ25FO0FBQ0Y7OztBRS9OQSxJQUFNLFdBQVcsb0JBQUksSUFBSSxDQUFDLEtBQUssTUFBTSxNQUFNLE1BQU0sTUFBTSxNQUFNLElBQUksQ0FBQztBQUdsRSxVQUFVLGFBQWE7QUFDckIsUUFBTSxVQUFVO0FBQ2hCLGFBQVcsVUFBVSxRQUFTLE9BQU07QUFDcEMsYUFBVyxTQUFTLFFBQVMsWUFBVyxVQUFVLFFBQVMsT0FBTSxRQUFRO0FBQzNFO0FBTU8sU0FBUyxjQUFjLFFBQVE7QUFDcEMsUUFBTSxRQUFRLENBQUM7QUFDZixRQUFNLGNBQWMsSUFBSSxJQUFJLE9BQU8sSUFBSSxDQUFDLEVBQUUsTUFBQUMsTUFBSyxNQUFNQSxLQUFJLENBQUM7QUFDMUQsUUFBTSxPQUFPLENBQUNDLE9BQU0sT0FBT0EsRUFBQyxHQUFHO0FBQy9CLE1BQUksSUFBSTtBQUdSLFFBQU0sZUFBZSxDQUFDLE9BQU87QUFDM0IsUUFBSSxRQUFRO0FBQ1osT0FBRztBQUNELFVBQUksTUFBTSxTQUFTLEtBQUssRUFBRSxDQUFDLEVBQUc7QUFDOUIsVUFBSSxNQUFNLFNBQVMsS0FBSyxFQUFFLENBQUMsRUFBRztBQUM5QjtBQUFBLElBQ0YsU0FBUyxRQUFRLEtBQUssS0FBSyxPQUFPO0FBQ2xDLFdBQU87QUFBQSxFQUNUO0FBRUEsUUFBTSxhQUFhLE1BQU07QUFDdkIsVUFBTSxRQUFRLG9CQUFJLElBQUk7QUFDdEIsVUFBTSxhQUFhLFdBQVc7QUFDOUIsVUFBTSxXQUFXLENBQUMsU0FBUztBQUN6QixVQUFJLFFBQVEsTUFBTSxJQUFJLElBQUk7QUFDMUIsYUFBTyxVQUFVLFFBQVc7QUFDMUIsY0FBTSxFQUFFLE1BQU0sSUFBSSxXQUFXLEtBQUs7QUFDbEMsWUFBSSxVQUFVLE9BQVcsU0FBUTtBQUFBLGlCQUN4QixDQUFDLFlBQVksSUFBSSxLQUFLLEtBQUssQ0FBQyxTQUFTLElBQUksS0FBSyxFQUFHLFNBQVE7QUFBQSxNQUNwRTtBQUNBLFlBQU0sSUFBSSxNQUFNLEtBQUs7QUFDckIsYUFBTztBQUFBLElBQ1Q7QUFFQSxVQUFNLFNBQVMsQ0FBQyxvQkFBSSxJQUFJLENBQUM7QUFDekIsVUFBTSxVQUFVLENBQUMsU0FBUyxPQUFPLEdBQUcsRUFBRSxFQUFFLElBQUksSUFBSTtBQUNoRCxVQUFNLFVBQVUsQ0FBQyxPQUFPO0FBQ3RCLFlBQU0sRUFBRSxNQUFNLE1BQU0sTUFBTSxHQUFHLElBQUksT0FBTyxFQUFFO0FBQzFDLFlBQU0sUUFBUSxTQUFTLElBQUk7QUFDM0IsVUFBSSxNQUFNLFNBQVMsS0FBSyxPQUFRLE9BQU0sS0FBSyxFQUFFLE1BQU0sSUFBSSxNQUFNLE1BQU0sQ0FBQztBQUFBLElBQ3RFO0FBRUEsVUFBTSxnQkFBZ0IsTUFBTTtBQUMxQixXQUFLO0FBQ0wsVUFBSSxLQUFLLENBQUMsTUFBTSxJQUFLLEtBQUksYUFBYSxDQUFDO0FBQUEsSUFDekM7QUFFQSxTQUFLO0FBRUwsYUFBU0MsU0FBUSxPQUFNO0FBQ3JCLFlBQU0sUUFBUSxLQUFLLENBQUM7QUFDcEIsVUFBSSxVQUFVLEtBQUs7QUFDakIsc0JBQWM7QUFDZDtBQUFBLE1BQ0Y7QUFDQSxVQUFJLFVBQVUsT0FBTyxVQUFVLElBQUssQ0FBQUE7QUFDcEMsVUFBSSxVQUFVLE9BQU8sVUFBVSxJQUFLLENBQUFBO0FBQ3BDLFVBQUlBLFdBQVUsS0FBSyxLQUFLLElBQUksQ0FBQyxNQUFNLE9BQU8sYUFBYSxLQUFLLEtBQUssR0FBRztBQUNsRSxnQkFBUSxLQUFLO0FBQ2IsZ0JBQVEsQ0FBQztBQUFBLE1BQ1g7QUFDQTtBQUNBLFVBQUlBLFdBQVUsRUFBRztBQUFBLElBQ25CO0FBQ0EsV0FBTyxLQUFLLENBQUMsTUFBTSxJQUFLLE1BQUs7QUFHN0IsUUFBSSxVQUFVLENBQUM7QUFFZixVQUFNLFFBQVEsQ0FBQztBQUNmLFFBQUksUUFBUTtBQUNaLFVBQU0sU0FBUyxNQUFNO0FBQ25CLGNBQVEsUUFBUSxPQUFPO0FBQ3ZCLGdCQUFVLENBQUM7QUFBQSxJQUNiO0FBQ0EsUUFBSSxRQUFRO0FBQ1osT0FBRztBQUNELFlBQU0sUUFBUSxLQUFLLENBQUM7QUFDcEIsVUFBSSxVQUFVLEtBQUs7QUFDakIsc0JBQWM7QUFDZDtBQUFBLE1BQ0Y7QUFDQSxVQUFJLFVBQVUsT0FBTztBQUNuQixlQUFPLEtBQUssb0JBQUksSUFBSSxDQUFDO0FBQ3JCLGNBQU0sS0FBSyxFQUFFLE9BQU8sTUFBTSxDQUFDO0FBQUEsTUFDN0IsV0FBVyxVQUFVLElBQUs7QUFBQSxlQUNqQixVQUFVLElBQUs7QUFBQSxlQUNmLFVBQVUsSUFBSyxRQUFPO0FBQUEsZUFDdEIsVUFBVSxLQUFLO0FBQ3RCLGVBQU87QUFDUDtBQUNBLGVBQU8sS0FBSyxvQkFBSSxJQUFJLENBQUM7QUFBQSxNQUN2QixXQUFXLFVBQVUsS0FBSztBQUN4QixlQUFPO0FBQ1A7QUFDQSxlQUFPLElBQUk7QUFDWCxZQUFJLE1BQU0sR0FBRyxFQUFFLEdBQUcsVUFBVSxTQUFTLE1BQU0sR0FBRyxFQUFFLEVBQUUsVUFBVSxPQUFPO0FBQ2pFLGdCQUFNLElBQUk7QUFDVixpQkFBTyxJQUFJO0FBQUEsUUFDYjtBQUFBLE1BQ0YsV0FBVyxvQkFBb0IsS0FBSyxLQUFLLEdBQUc7QUFDMUMsWUFBSSxLQUFLLElBQUk7QUFDYixZQUFJLEtBQUssRUFBRSxNQUFNLElBQUssUUFBTyxLQUFLLElBQUksTUFBTSxJQUFJO0FBQ2hELGdCQUFRLEtBQUssS0FBSyxFQUFFLENBQUM7QUFFckIsZ0JBQVEsRUFBRTtBQUNWLFlBQUk7QUFBQSxNQUNOLFdBQVcsYUFBYSxLQUFLLEtBQUssS0FBSyxLQUFLLElBQUksQ0FBQyxNQUFNLE9BQU8sT0FBTyxLQUFLLENBQUMsVUFBVSxNQUFNLElBQUksS0FBSyxDQUFDO0FBQ25HLGdCQUFRLENBQUM7QUFDWDtBQUFBLElBQ0YsU0FBUyxRQUFRO0FBQUEsRUFDbkI7QUFFQSxTQUFPLElBQUksT0FBTyxRQUFRO0FBQ3hCLFFBQUksS0FBSyxDQUFDLE1BQU0sS0FBTSxZQUFXO0FBQUEsUUFDNUI7QUFBQSxFQUNQO0FBQ0EsU0FBTztBQUNUOzs7QUh0SEEsSUFBTSxVQUFVLEVBQUUsS0FBSyxLQUFLLEtBQUssS0FBSyxLQUFLLEtBQUssS0FBSyxJQUFJO0FBWWxELFNBQVMsVUFBVSxNQUFNLE9BQU8sZUFBZTtBQUNwRCxRQUFNLE9BQU8sQ0FBQyxJQUFJLFlBQVk7QUFDNUIsVUFBTSxJQUFJLFVBQVUsR0FBRyxJQUFJLElBQUksS0FBSyxNQUFNLEdBQUcsRUFBRSxFQUFFLE1BQU0sSUFBSSxFQUFFLE1BQU0sS0FBSyxPQUFPLEdBQUc7QUFBQSxFQUNwRjtBQUNBLFFBQU0sRUFBRSxRQUFRLFNBQVMsSUFBSSxTQUFTLE1BQU0sSUFBSTtBQUNoRCxRQUFNLFVBQVUsQ0FBQztBQUNqQixRQUFNLFFBQVEsQ0FBQztBQUNmLE1BQUksT0FBTztBQUNYLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHO0FBQ2pDLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHLFFBQVEsS0FBSztBQUM5QyxRQUFNLE9BQU8sQ0FBQyxhQUFhO0FBQ3pCLFVBQU0sUUFBUSxPQUFPLElBQUk7QUFDekIsUUFBSSxDQUFDLE1BQU8sUUFBTyxLQUFLLEtBQUssUUFBUSxXQUFXLElBQUksUUFBUSw0QkFBNEIsd0JBQXdCO0FBQ2hILFFBQUksYUFBYSxVQUFhLE1BQU0sU0FBUztBQUMzQyxXQUFLLE1BQU0sTUFBTSxJQUFJLE1BQU0sSUFBSSxtQkFBbUIsUUFBUSxlQUFlO0FBQzNFO0FBQ0EsV0FBTztBQUFBLEVBQ1Q7QUFDQSxRQUFNLFlBQVksTUFBTSxPQUFPLE9BQU8sQ0FBQyxFQUFFO0FBR3pDLFFBQU0sY0FBYyxNQUFNO0FBQ3hCLFVBQU0sT0FBTyxLQUFLO0FBQ2xCLGVBQVcsUUFBUSxRQUFRLEtBQUssSUFBSSxHQUFHLEtBQUssTUFBTSxRQUFRLFdBQVU7QUFDcEUsU0FBSztBQUFBLEVBQ1A7QUFDQSxRQUFNLFlBQVksTUFBTTtBQUN0QixRQUFJLEtBQUssTUFBTSxPQUFXLE1BQUssS0FBSyxRQUFRLG1DQUFtQztBQUMvRSxRQUFJLEtBQUssTUFBTSxPQUFPLG1CQUFtQixLQUFLLE9BQU8sT0FBTyxDQUFDLEdBQUcsUUFBUSxFQUFFO0FBQ3hFO0FBQUEsUUFDRSxLQUFLO0FBQUEsUUFDTCxJQUFJLE9BQU8sT0FBTyxDQUFDLEVBQUUsSUFBSTtBQUFBLE1BQzNCO0FBQ0YsUUFBSSxLQUFLLEtBQUssV0FBVyxLQUFLLE1BQU0sSUFBSyxhQUFZO0FBQUEsUUFDaEQsTUFBSztBQUFBLEVBQ1o7QUFDQSxRQUFNLFNBQVMsSUFBSSxTQUFTO0FBQzFCLFdBQU8sQ0FBQyxLQUFLLFNBQVMsS0FBSyxDQUFDLEVBQUcsV0FBVTtBQUFBLEVBQzNDO0FBR0EsUUFBTSxZQUFZLE1BQU07QUFDdEIsVUFBTSxPQUFPLEtBQUssR0FBRyxFQUFFO0FBQ3ZCLFVBQU0sUUFBUSxDQUFDO0FBQ2YsT0FBRztBQUNELFVBQUksTUFBTSxTQUFTLEVBQUcsTUFBSyxJQUFJO0FBQy9CLFVBQUksVUFBVTtBQUNkLGFBQU8sS0FBSyxNQUFNLEtBQUs7QUFDckIsYUFBSztBQUNMLGtCQUFVLENBQUM7QUFBQSxNQUNiO0FBQ0EsWUFBTSxPQUFPLEtBQUs7QUFDbEIsVUFBSSxDQUFDLGlCQUFpQixLQUFLLEtBQUssSUFBSTtBQUNsQztBQUFBLFVBQ0UsS0FBSztBQUFBLFVBQ0w7QUFBQSxRQUNGO0FBQ0YsWUFBTSxLQUFLLEdBQUcsVUFBVSxNQUFNLEVBQUUsR0FBRyxLQUFLLElBQUksRUFBRTtBQUFBLElBQ2hELFNBQVMsS0FBSyxNQUFNO0FBQ3BCLFFBQUksS0FBSyxNQUFNO0FBQ2I7QUFBQSxRQUNFO0FBQUEsUUFDQTtBQUFBLE1BQ0Y7QUFDRixTQUFLLEdBQUc7QUFDUixXQUFPLE1BQU0sS0FBSyxJQUFJO0FBQUEsRUFDeEI7QUFHQSxRQUFNLGFBQWEsTUFBTTtBQUN2QixRQUFJO0FBQ0osV0FBTyxLQUFLLE1BQU0sS0FBSztBQUNyQixZQUFNLEVBQUUsS0FBSyxJQUFJLEtBQUssR0FBRztBQUN6QixZQUFNLE9BQU8sS0FBSztBQUNsQixVQUFJLG1CQUFtQixLQUFLLEtBQUssSUFBSSxHQUFHO0FBQ3RDLFlBQUksS0FBTSxNQUFLLE1BQU0sZ0RBQWdEO0FBQ3JFLGVBQU8sRUFBRSxNQUFNLEtBQUssTUFBTSxNQUFNLFdBQVcsS0FBSyxTQUFTLFNBQVMsU0FBWSxVQUFVLEdBQUcsSUFBSSxFQUFFO0FBQ2pHLGFBQUssS0FBSyxVQUFVO0FBQUEsTUFDdEIsV0FBVyxLQUFLLE1BQU0sSUFBSyxhQUFZO0FBQUEsSUFDekM7QUFDQSxXQUFPO0FBQUEsRUFDVDtBQUVBLFFBQU0sYUFBYSxDQUFDLFNBQVM7QUFDM0IsVUFBTSxRQUFRLENBQUM7QUFDZixVQUFNLFNBQVMsQ0FBQyxXQUFXO0FBQ3pCLFVBQUksS0FBSyxNQUFNLEtBQUs7QUFDbEIsYUFBSyxHQUFHO0FBQ1IsZUFBTyxLQUFLLE1BQU0sS0FBSztBQUNyQixpQkFBTyxNQUFNO0FBQ2IsY0FBSSxLQUFLLE1BQU0sSUFBSyxNQUFLLEdBQUc7QUFBQSxRQUM5QjtBQUNBLGFBQUssR0FBRztBQUNSO0FBQUEsTUFDRjtBQUNBLFlBQU0sT0FBTyxLQUFLO0FBQ2xCLFVBQUksQ0FBQyxpQkFBaUIsS0FBSyxLQUFLLElBQUksRUFBRyxNQUFLLEtBQUssTUFBTSxJQUFJLEtBQUssSUFBSSx3QkFBd0I7QUFDNUYsVUFBSSxLQUFLLE1BQU0sTUFBTTtBQUNuQixhQUFLLElBQUk7QUFDVCxlQUFPLENBQUMsR0FBRyxRQUFRLEtBQUssSUFBSSxDQUFDO0FBQUEsTUFDL0IsV0FBVyxLQUFLLE1BQU0sS0FBTSxNQUFLLEtBQUssR0FBRyxtRUFBbUU7QUFBQSxVQUN2RyxPQUFNLEtBQUssRUFBRSxNQUFNLFFBQVEsTUFBTSxLQUFLLE1BQU0sSUFBSSxLQUFLLEtBQUssQ0FBQztBQUFBLElBQ2xFO0FBQ0EsV0FBTyxJQUFJO0FBQ1gsV0FBTztBQUFBLEVBQ1Q7QUFFQSxRQUFNLGtCQUFrQixDQUFDLE1BQU0sU0FBUztBQUN0QyxRQUFJLFNBQVMsS0FBSyxTQUFTLFFBQVEsS0FBSyxVQUFVLFNBQVMsR0FBRztBQUM1RCxXQUFLLE1BQU0sK0NBQStDO0FBQzVELFNBQUssUUFBUTtBQUNiLGVBQVcsRUFBRSxNQUFNLE1BQU0sR0FBRyxLQUFLLFdBQVcsQ0FBQyxDQUFDLEdBQUc7QUFDL0MsVUFBSSxLQUFLLFdBQVcsRUFBRyxNQUFLLElBQUksV0FBVyxJQUFJLG1CQUFtQjtBQUNsRSxjQUFRLEtBQUssRUFBRSxNQUFNLE1BQU0sTUFBTSxNQUFNLFdBQVcsTUFBTSxLQUFLLE1BQU0sR0FBRyxFQUFFLEVBQUUsTUFBTSxJQUFJLEVBQUUsT0FBTyxDQUFDO0FBQUEsSUFDaEc7QUFDQSxTQUFLLEdBQUc7QUFFUixVQUFNLEtBQUssRUFBRSxNQUFNLElBQUksVUFBVSxHQUFHLE1BQU0sS0FBSyxNQUFNLE1BQU0sVUFBVSxDQUFDLEVBQUUsUUFBUSxXQUFXLEVBQUUsRUFBRSxDQUFDO0FBQUEsRUFDbEc7QUFFQSxRQUFNLFFBQVEsTUFBTTtBQUNsQixTQUFLLEdBQUc7QUFDUixhQUFTLFdBQVcsR0FBRztBQUN2QixTQUFLLEdBQUc7QUFBQSxFQUNWO0FBRUEsUUFBTSxjQUFjLE1BQU07QUFDeEIsUUFBSSxLQUFLLE1BQU0sTUFBTTtBQUNuQixXQUFLO0FBQ0wsV0FBSztBQUNMLFdBQUssR0FBRztBQUNSLGVBQVMsT0FBTyxHQUFHLEdBQUcsR0FBRztBQUN6QixXQUFLLEdBQUc7QUFDUixhQUFPLEdBQUc7QUFDVixZQUFNO0FBQUEsSUFDUixXQUFXLEtBQUssTUFBTSxVQUFVO0FBQzlCLFdBQUs7QUFDTCxXQUFLO0FBQ0wsV0FBSyxHQUFHO0FBQ1IsZUFBUyxPQUFPLEdBQUcsR0FBRyxHQUFHO0FBQ3pCLFdBQUssR0FBRztBQUNSLFVBQUksS0FBSyxNQUFNLElBQUssTUFBSztBQUFBLElBQzNCLE9BQU87QUFDTCxVQUFJLEtBQUssTUFBTSxJQUFLLFFBQU8sR0FBRztBQUM5QixXQUFLLEdBQUc7QUFBQSxJQUNWO0FBQUEsRUFDRjtBQUdBLFFBQU0sU0FBUyxDQUFDLFVBQVUsTUFBTTtBQUM5QixRQUFJLFFBQVE7QUFDWixXQUFPLFFBQVEsS0FBTSxLQUFLLE1BQU0sT0FBTyxLQUFLLE1BQU0sT0FBUTtBQUN4RCxVQUFJLEtBQUssTUFBTSxJQUFLO0FBQ3BCLFVBQUksS0FBSyxNQUFNLElBQUs7QUFDcEIsZ0JBQVU7QUFBQSxJQUNaO0FBQ0EsUUFBSSxLQUFLLE1BQU0sSUFBSyxNQUFLO0FBQUEsRUFDM0I7QUFFQSxRQUFNLFNBQVMsTUFBTTtBQUNuQixRQUFJLEtBQUssTUFBTSxVQUFVLEtBQUssTUFBTSxVQUFXLE1BQUssS0FBSyxHQUFHLElBQUksS0FBSyxDQUFDLG1DQUFtQztBQUN6RyxXQUFPLEdBQUc7QUFDVixVQUFNO0FBQUEsRUFDUjtBQUVBLFFBQU0sWUFBWSxNQUFNO0FBQ3RCLFlBQVEsS0FBSyxHQUFHO0FBQUEsTUFDZCxLQUFLO0FBQ0gsZUFBTyxNQUFNO0FBQUEsTUFDZixLQUFLO0FBQUEsTUFDTCxLQUFLO0FBQUEsTUFDTCxLQUFLO0FBQ0gsYUFBSztBQUNMLGVBQU8sR0FBRztBQUNWLGNBQU07QUFDTixlQUFPLEtBQUssTUFBTSxRQUFRO0FBQ3hCLGVBQUs7QUFDTCxpQkFBTyxHQUFHO0FBQ1YsZ0JBQU07QUFBQSxRQUNSO0FBQ0EsZUFBTztBQUFBLE1BQ1QsS0FBSztBQUFBLE1BQ0wsS0FBSztBQUNILGFBQUs7QUFDTCxlQUFPLEdBQUc7QUFDVixlQUFPLE1BQU07QUFBQSxNQUNmLEtBQUs7QUFDSCxhQUFLO0FBQ0wsZUFBTyxHQUFHO0FBQ1YsYUFBSyxHQUFHO0FBQ1IsaUJBQVMsUUFBUSxHQUFHO0FBQ3BCLGFBQUssR0FBRztBQUNSLGVBQU87QUFBQSxNQUNUO0FBQ0UsZUFBTyxLQUFLLEdBQUc7QUFDZixhQUFLLEdBQUc7QUFDUixlQUFPO0FBQUEsSUFDWDtBQUFBLEVBQ0Y7QUFHQSxRQUFNLFdBQVcsQ0FBQyxTQUFTLFVBQVU7QUFFbkMsUUFBSSxPQUFPO0FBQ1gsUUFBSSxNQUFNO0FBQ1YsUUFBSTtBQUNKLFVBQU0sYUFBYSxNQUFNO0FBQ3ZCLFVBQUksT0FBTztBQUNULGNBQU0sS0FBSyxFQUFFLE1BQU0sS0FBSyxJQUFJLEtBQUssTUFBTSxHQUFHLFdBQVcsT0FBTyxJQUFJLENBQUMsR0FBRyxLQUFLLEtBQUssS0FBSyxHQUFHLEtBQUssRUFBRSxJQUFJLE1BQU0sRUFBRSxHQUFHLENBQUM7QUFDL0csYUFBTztBQUNQLGNBQVE7QUFBQSxJQUNWO0FBQ0EsV0FBTyxLQUFLLE1BQU0sT0FBTztBQUN2QixVQUFJLEtBQUssTUFBTSxPQUFXLE1BQUssS0FBSyxRQUFRLElBQUksS0FBSyx5QkFBeUI7QUFDOUUsWUFBTSxPQUFPLEtBQUs7QUFDbEIsWUFBTSxPQUFPLFdBQVc7QUFFeEIsWUFBTSxTQUFTLE1BQU0sU0FBUyxRQUFRLEtBQUssY0FBYyxTQUFTLEtBQUssTUFBTTtBQUM3RSxXQUFLLENBQUMsUUFBUSxLQUFLLFNBQVMsU0FBUyxDQUFDLE9BQVEsWUFBVztBQUN6RCxVQUFJLEtBQUssTUFBTSxZQUFZLFVBQVUsUUFBVztBQUM5Qyx3QkFBZ0IsTUFBTSxJQUFJO0FBQzFCO0FBQUEsTUFDRjtBQUNBLFVBQUksTUFBTTtBQUNSLFlBQUksS0FBSyxTQUFTLFFBQVEsU0FBUyxFQUFHLE1BQUssS0FBSyxNQUFNLElBQUksS0FBSyxJQUFJLHdCQUF3QjtBQUMzRixjQUFNLFFBQVEsS0FBSyxTQUFTLE9BQU8sS0FBSztBQUN4QyxjQUFNLE1BQU0sS0FBSyxLQUFLLEtBQUssS0FBSyxFQUFFLEtBQUssR0FBRyxJQUFJLEtBQUs7QUFDbkQsY0FBTSxRQUFRLFNBQVMsS0FBSyxHQUFHLEtBQUssR0FBRyxLQUFLLGNBQWMsU0FBWSxLQUFLLFNBQVMsS0FBSyxTQUFTLEVBQUU7QUFDcEcsY0FBTSxLQUFLLEVBQUUsTUFBTSxLQUFLLE1BQU0sSUFBSSxLQUFLLElBQUksTUFBTSxHQUFHLEtBQUssR0FBRyxHQUFHLEdBQUcsQ0FBQztBQUNuRSxZQUFJLEtBQUssY0FBYyxVQUFhLENBQUMsT0FBUTtBQUM3QyxnQkFBUSxLQUFLLFNBQVMsT0FBTyxLQUFLLFlBQVk7QUFBQSxNQUNoRDtBQUNBLGNBQVE7QUFDUixZQUFNLFVBQVU7QUFDaEIsVUFBSSxNQUFNLFNBQVMsT0FBUSxZQUFXO0FBQUEsSUFDeEM7QUFDQSxlQUFXO0FBQUEsRUFDYjtBQUVBLFdBQVMsYUFBYSxNQUFTO0FBQy9CLGFBQVcsRUFBRSxNQUFNLEdBQUcsS0FBSztBQUN6QixRQUFJLEtBQUssTUFBTSxNQUFNLEVBQUUsRUFBRSxTQUFTLEtBQUssRUFBRyxNQUFLLE1BQU0sa0RBQWtEO0FBQ3pHLFNBQU8sRUFBRSxTQUFTLE9BQU8sVUFBVSxPQUFPO0FBQzVDO0FBRUEsSUFBTSxXQUFXO0FBTVYsU0FBUyxRQUFRLE1BQU07QUFDNUIsTUFBSSxLQUFLLFNBQVMsSUFBSSxFQUFHLFFBQU87QUFDaEMsUUFBTSxTQUFTLEtBQUssUUFBUSx3QkFBd0IsQ0FBQyxRQUFRLFFBQVEsVUFBVTtBQUM3RSxVQUFNLFlBQVksS0FBSyxLQUFLLE1BQU0sS0FBSyxLQUFLLEtBQUssS0FBSztBQUN0RCxXQUFPLGFBQWMsU0FBUyxLQUFLLE1BQU0sS0FBSyxTQUFTLEtBQUssS0FBSyxJQUFLLFNBQVM7QUFBQSxFQUNqRixDQUFDO0FBRUQsU0FBTyxPQUFPLFFBQVEseUJBQXlCLEVBQUUsRUFBRSxRQUFRLHdCQUF3QixFQUFFO0FBQ3ZGO0FBR0EsSUFBTSxlQUFlLENBQUMsU0FDcEIsS0FDRyxNQUFNLGtDQUFrQyxFQUN4QyxJQUFJLENBQUMsTUFBTSxNQUFNO0FBQ2hCLE1BQUksSUFBSSxFQUFHLFFBQU87QUFDbEIsUUFBTSxPQUFPLFFBQVEsS0FBSyxLQUFLLENBQUM7QUFDaEMsU0FBTyxJQUFJLEtBQUssTUFBTSxLQUFLLElBQUksSUFBSSxJQUFJLElBQUksS0FBSztBQUNsRCxDQUFDLEVBQ0EsS0FBSyxFQUFFO0FBRVosU0FBUyxNQUFNLE1BQU0sT0FBTztBQUMxQixNQUFJLFNBQVM7QUFDYixhQUFXLFFBQVEsQ0FBQyxHQUFHLEtBQUssRUFBRSxLQUFLLENBQUMsR0FBRyxNQUFNLEVBQUUsT0FBTyxFQUFFLFFBQVEsRUFBRSxLQUFLLEVBQUUsRUFBRTtBQUN6RSxhQUFTLE9BQU8sTUFBTSxHQUFHLEtBQUssSUFBSSxJQUFJLEtBQUssT0FBTyxPQUFPLE1BQU0sS0FBSyxFQUFFO0FBQ3hFLFNBQU87QUFDVDtBQU1BLFNBQVMsVUFBVSxNQUFNLEVBQUUsT0FBTyxVQUFVLE9BQU8sR0FBRyxRQUFRO0FBQzVELE1BQUksQ0FBQyxPQUFRLFFBQU8sTUFBTSxNQUFNLEtBQUs7QUFDckMsUUFBTSxPQUFPLE1BQU0sTUFBTTtBQUFBLElBQ3ZCLEdBQUc7QUFBQSxJQUNILEdBQUcsY0FBYyxNQUFNO0FBQUEsSUFDdkIsR0FBRyxTQUFTLElBQUksQ0FBQyxFQUFFLE1BQU0sR0FBRyxPQUFPLEVBQUUsTUFBTSxJQUFJLE1BQU0sS0FBSyxNQUFNLE1BQU0sRUFBRSxFQUFFLFFBQVEsV0FBVyxFQUFFLEtBQUssSUFBSSxFQUFFO0FBQUEsRUFDNUcsQ0FBQztBQUNELFNBQU8sS0FBSyxNQUFNLElBQUksRUFBRSxJQUFJLFlBQVksRUFBRSxLQUFLLElBQUk7QUFDckQ7QUFHQSxTQUFTLFVBQVUsTUFBTTtBQUN2QixXQUFTLFNBQVMsUUFBUSxJQUFJLEdBQUcsV0FBVyxRQUFRLE1BQU0sR0FBRyxTQUFTLFFBQVEsTUFBTSxHQUFHO0FBQ3JGLFVBQU0sV0FBV0MsTUFBSyxRQUFRLGNBQWM7QUFDNUMsUUFBSUMsWUFBVyxRQUFRO0FBQ3JCLGFBQU8sRUFBRSxRQUFRLE9BQU8sS0FBSyxNQUFNQyxjQUFhLFVBQVUsTUFBTSxDQUFDLEVBQUUsS0FBSyxNQUFNLEdBQUcsRUFBRSxHQUFHLEVBQUUsRUFBRTtBQUFBLEVBQzlGO0FBQ0EsUUFBTSxJQUFJLFVBQVUsR0FBRyxJQUFJLDBCQUEwQjtBQUN2RDtBQU1BLElBQU0sV0FBVyxDQUFDLFNBQVMsZ0NBQWdDLEtBQUssSUFBSTtBQUc3RCxJQUFNLFNBQVMsQ0FBQyxTQUFTLEtBQUssR0FBRyxFQUFFLE1BQU07QUFPaEQsU0FBUyxjQUFjLEVBQUUsTUFBTSxNQUFNLEtBQUssR0FBRyxNQUFNLFFBQVE7QUFDekQsUUFBTSxDQUFDLE1BQU0sR0FBRyxJQUFJLElBQUk7QUFDeEIsUUFBTSxTQUFTLFNBQVMsWUFBWSxTQUFTLFNBQVMsVUFBVSxRQUFRLElBQUksSUFBSTtBQUNoRixNQUFJLFdBQVcsT0FBVyxPQUFNLElBQUksVUFBVSxHQUFHLElBQUksSUFBSSxJQUFJLE1BQU0sSUFBSSwyQ0FBMkM7QUFDbEgsUUFBTSxPQUFPLFFBQVEsUUFBUSxHQUFHLElBQUk7QUFDcEMsTUFBSUQsWUFBVyxHQUFHLElBQUksT0FBTyxFQUFHLFFBQU8sRUFBRSxNQUFNLEdBQUcsSUFBSSxTQUFTLE1BQU0sS0FBSztBQUMxRSxRQUFNLGFBQWEsR0FBR0QsTUFBSyxRQUFRLElBQUksSUFBSSxLQUFLLEdBQUcsRUFBRSxLQUFLLElBQUksV0FBVyxLQUFLLEdBQUcsQ0FBQyxDQUFDO0FBQ25GLE1BQUlDLFlBQVcsVUFBVSxFQUFHLFFBQU8sRUFBRSxNQUFNLFlBQVksTUFBTSxNQUFNO0FBQ25FLFFBQU0sSUFBSTtBQUFBLElBQ1IsR0FBRyxJQUFJLElBQUksSUFBSSx3QkFBd0IsS0FBSyxLQUFLLElBQUksQ0FBQyxjQUFjLElBQUksa0JBQWtCLElBQUksYUFBYSxVQUFVO0FBQUEsRUFDdkg7QUFDRjtBQWVPLFNBQVMsWUFBWSxNQUFNLE1BQU0sRUFBRSxTQUFTLE9BQU8sT0FBTyxNQUFNLElBQUksQ0FBQyxHQUFHO0FBQzdFLFFBQU0sU0FBUyxVQUFVLE1BQU0sSUFBSTtBQUNuQyxRQUFNLEVBQUUsUUFBUSxNQUFNLElBQUksVUFBVSxJQUFJO0FBQ3hDLFFBQU0sU0FBU0QsTUFBSyxRQUFRLEtBQUs7QUFDakMsUUFBTSxRQUFRLG9CQUFJLElBQUk7QUFDdEIsUUFBTSxlQUFlLG9CQUFJLElBQUk7QUFDN0IsUUFBTSxVQUFVLG9CQUFJLElBQUk7QUFDeEIsUUFBTSxPQUFPLG9CQUFJLElBQUksQ0FBQyxZQUFZLENBQUM7QUFDbkMsTUFBSSxVQUFVO0FBQ2QsYUFBVyxTQUFTLE9BQU8sU0FBUztBQUNsQyxRQUFJLE9BQU8sTUFBTSxJQUFJLEVBQUc7QUFDeEIsVUFBTSxFQUFFLE1BQU0sUUFBUSxLQUFLLElBQUksY0FBYyxPQUFPLE1BQU0sTUFBTTtBQUNoRSxVQUFNLFlBQVksS0FBS0csVUFBUyxRQUFRLElBQUksR0FBRyxNQUFNLEVBQUUsTUFBTSxHQUFHLEVBQUUsS0FBSyxHQUFHLENBQUMsR0FDeEUsUUFBUSxlQUFlLEtBQUssRUFDNUIsUUFBUSxTQUFTLEVBQUU7QUFDdEIsUUFBSSxDQUFDLFFBQVEsU0FBUyxNQUFNLElBQUksR0FBRztBQUNqQyxVQUFJLFFBQVEsSUFBSSxNQUFNLElBQUksRUFBRztBQUM3QixjQUFRLElBQUksTUFBTSxNQUFNLFNBQVMsUUFBUSxJQUFJLEVBQUU7QUFDL0MsaUJBQVcsWUFBWSxNQUFNLElBQUksT0FBTyxRQUFRLElBQUksTUFBTSxJQUFJLENBQUMsV0FBVyxLQUFLLFVBQVUsU0FBUyxDQUFDO0FBQ25HO0FBQUEsSUFDRjtBQUNBLFVBQU0sTUFBTSxPQUFPLFlBQVksR0FBRyxTQUFTLElBQUksTUFBTSxJQUFJO0FBQ3pELFFBQUksT0FBTyxNQUFNLElBQUksR0FBRztBQUN4QixRQUFJLFNBQVMsUUFBVztBQUN0QixZQUFNLElBQUksS0FBTSxPQUFPLFNBQVMsTUFBTSxJQUFJLEVBQUc7QUFDN0MsaUJBQVcsVUFBVSxPQUFPLE9BQU8sS0FBSyxNQUFNLElBQUksT0FBTyxJQUFJLElBQUksU0FBUyxLQUFLLFVBQVUsU0FBUyxDQUFDO0FBQUEsSUFDckc7QUFDQSxRQUFJLE1BQU0sU0FBUyxPQUFXLE1BQUssSUFBSSxPQUFPO0FBQzlDLFVBQU0sYUFDSixNQUFNLFNBQVMsU0FBWSxPQUFPLHlCQUF5QixLQUFLLFVBQVUsTUFBTSxJQUFJLENBQUMsS0FBSyxJQUFJO0FBQ2hHLGlCQUFhLElBQUksWUFBWSxVQUFVO0FBQUEsRUFDekM7QUFDQSxRQUFNLFFBQVEsR0FBRyxLQUFLLElBQUksS0FDdkIsTUFBTSxPQUFPLEVBQ2IsR0FBRyxFQUFFLEVBQ0wsUUFBUSxXQUFXLEVBQUUsRUFDckIsV0FBVyxLQUFLLEdBQUcsQ0FBQztBQUN2QixRQUFNLFFBQVEsVUFBVSxNQUFNLFFBQVEsVUFBVSxJQUFJO0FBQ3BELFFBQU0sWUFBWSxPQUFPLE1BQU0sUUFBUSxVQUFVLElBQUksRUFBRSxVQUFVLElBQUksT0FDbEUsUUFBUSxtQkFBbUIsTUFBTSxFQUNqQyxRQUFRLGlCQUFpQixDQUFDLFNBQVUsUUFBUSxJQUFJLElBQUksSUFBSSxNQUFNLFFBQVEsSUFBSSxJQUFJLENBQUMsT0FBTyxJQUFLO0FBRTlGLFFBQU0sT0FBTyxZQUFZLENBQUMsR0FBRyxJQUFJLEVBQUUsS0FBSyxFQUFFLEtBQUssSUFBSSxDQUFDLGdDQUFnQyxPQUFPLDZDQUE2QyxLQUFLLFVBQVUsS0FBSyxDQUFDLE9BQU8sUUFBUSxLQUFLLGFBQWEsT0FBTyxJQUFJLE1BQU0sQ0FBQyxHQUFHLGFBQWEsT0FBTyxDQUFDLEVBQUUsS0FBSyxJQUFJLENBQUMsTUFBTSxFQUFFO0FBQUE7QUFDNVAsUUFBTSxZQUFZLGNBQWMsTUFBTSxJQUFJO0FBQzFDLFFBQU0sV0FBVyxPQUFPLFFBQVEsT0FBTyxLQUFLLE1BQU0sSUFBSSxFQUFFLFNBQVMsQ0FBQyxDQUFDO0FBQ25FLFNBQU87QUFBQSxJQUNMLE1BQU0sWUFBWSxPQUFPLGtCQUFrQixTQUFTLElBQUk7QUFBQSxJQUN4RCxLQUFLLEVBQUUsU0FBUyxHQUFHLFNBQVMsQ0FBQyxLQUFLLE1BQU0sT0FBTyxFQUFFLEdBQUcsRUFBRSxDQUFDLEdBQUcsZ0JBQWdCLENBQUMsSUFBSSxHQUFHLE9BQU8sQ0FBQyxHQUFHLFNBQVM7QUFBQSxFQUN4RztBQUNGO0FBR08sSUFBTSxhQUFhLENBQUMsVUFBVSxDQUFDLE9BQU87QUFBQSxFQUMzQyxNQUFNO0FBQUEsRUFDTixNQUFNQyxRQUFPO0FBQ1gsSUFBQUEsT0FBTSxPQUFPLEVBQUUsUUFBUSxVQUFVLEdBQUcsQ0FBQyxFQUFFLEtBQUssTUFBTTtBQUNoRCxZQUFNLEVBQUUsTUFBTSxJQUFJLElBQUksWUFBWUYsY0FBYSxNQUFNLE1BQU0sR0FBRyxNQUFNLE9BQU87QUFDM0UsYUFBTztBQUFBLFFBQ0wsVUFBVSxHQUFHLElBQUkscURBQXFELE9BQU8sS0FBSyxLQUFLLFVBQVUsR0FBRyxDQUFDLEVBQUUsU0FBUyxRQUFRLENBQUM7QUFBQSxRQUN6SCxRQUFRO0FBQUEsUUFDUixZQUFZLFFBQVEsSUFBSTtBQUFBLE1BQzFCO0FBQUEsSUFDRixDQUFDO0FBQUEsRUFDSDtBQUNGOzs7QURsYndKLElBQU1HLDRDQUEyQztBQVV6TSxlQUFzQixXQUFXLFdBQW1CLE1BQWdDO0FBQ2xGLFFBQU0sRUFBRSxZQUFZLElBQUksTUFBTSxNQUFNO0FBQUEsSUFDbEMsT0FBTztBQUFBLE1BQ0wsVUFBVSxZQUFZLElBQUkscUJBQXFCLFNBQVM7QUFBQSxNQUN4RCxZQUFZQyxlQUFjLElBQUksSUFBSSxLQUFLRCx5Q0FBZSxDQUFDO0FBQUEsSUFDekQ7QUFBQSxJQUNBLFlBQVksQ0FBQyxlQUFlO0FBQUEsSUFDNUIsUUFBUTtBQUFBLElBQ1IsUUFBUTtBQUFBLElBQ1IsVUFBVTtBQUFBLElBQ1YsU0FBUyxDQUFDLFdBQVcsQ0FBQztBQUFBLElBQ3RCLE9BQU87QUFBQSxFQUNULENBQUM7QUFDRCxRQUFNLEVBQUUsTUFBTSxJQUFLLE1BQU0sT0FDdkIsK0JBQStCLE9BQU8sS0FBSyxZQUFZLENBQUMsRUFBRyxRQUFRLEVBQUUsU0FBUyxRQUFRLENBQUM7QUFFekYsU0FBTztBQUNUOzs7QUZoQkEsSUFBTywwQkFBUSxhQUFhO0FBQUEsRUFDMUIsT0FBTyxDQUFDLHNEQUFzRDtBQUFBLEVBQzlELE1BQU0sT0FBc0I7QUFDMUIsVUFBTSxRQUFTLE1BQU0sV0FBVyw2QkFBNkIsb0JBQW9CO0FBSWpGLFVBQU0sU0FBVSxNQUFNLFdBQVcsWUFBWSxrQkFBa0I7QUFDL0QsV0FBTyxjQUFjLE9BQU8sT0FBTyxDQUFDO0FBQUEsRUFDdEM7QUFDRixDQUFDOyIsCiAgIm5hbWVzIjogWyJmaWxlVVJMVG9QYXRoIiwgImV4aXN0c1N5bmMiLCAicmVhZEZpbGVTeW5jIiwgImpvaW4iLCAicmVsYXRpdmUiLCAidGV4dCIsICJpIiwgImRlcHRoIiwgImpvaW4iLCAiZXhpc3RzU3luYyIsICJyZWFkRmlsZVN5bmMiLCAicmVsYXRpdmUiLCAiYnVpbGQiLCAiX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCIsICJmaWxlVVJMVG9QYXRoIl0KfQo=
