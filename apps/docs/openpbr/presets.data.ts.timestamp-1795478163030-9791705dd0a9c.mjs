// openpbr/presets.data.ts
import { existsSync as existsSync3 } from "node:fs";
import { fileURLToPath as fileURLToPath3 } from "node:url";
import { defineLoader } from "file:///tmp/wt-me/node_modules/.pnpm/vitepress@1.6.4_@algolia+client-search@5.64.0_@types+node@20.19.43_@types+react@18.3.31_537527902d3afdea87a6bee698b64944/node_modules/vitepress/dist/node/index.js";

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

// openpbr/presets.data.ts
var __vite_injected_original_import_meta_url3 = "file:///tmp/wt-me/apps/docs/openpbr/presets.data.ts";
var number = (value) => String(Math.round(value * 1e3) / 1e3);
var print = (value) => Array.isArray(value) ? `[${value.map(number).join(", ")}]` : typeof value === "number" ? number(value) : String(value);
var presets_data_default = defineLoader({
  watch: ["../../../packages/openpbr/src/presets/*.ts", "../public/presets/*.webp"],
  async load() {
    const presets = await readExport("@glanz/openpbr/presets", "OPENPBR_PRESETS");
    return Object.entries(presets).map(([name, parameters]) => ({
      name,
      text: Object.entries(parameters).map(([key, value]) => `${key}: ${print(value)}`).join("\n"),
      image: existsSync3(fileURLToPath3(new URL(`../public/presets/${name}.webp`, __vite_injected_original_import_meta_url3))) ? `/presets/${name}.webp` : void 0
    }));
  }
});
export {
  presets_data_default as default
};
//# sourceMappingURL=data:application/json;base64,ewogICJ2ZXJzaW9uIjogMywKICAic291cmNlcyI6IFsib3BlbnBici9wcmVzZXRzLmRhdGEudHMiLCAic3JjL3JlYWQtZXhwb3J0LnRzIiwgIi4uLy4uL3Rvb2xzL3BpcGVsaW5lL3dlc2wubWpzIiwgIi4uLy4uL3Rvb2xzL3BpcGVsaW5lL3dlc2wtY29uc3RhbnRzLm1qcyIsICIuLi8uLi90b29scy9waXBlbGluZS93ZXNsLXRva2Vucy5tanMiLCAiLi4vLi4vdG9vbHMvcGlwZWxpbmUvd2VzbC1uYW1lcy5tanMiXSwKICAic291cmNlc0NvbnRlbnQiOiBbImNvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9kaXJuYW1lID0gXCIvdG1wL3d0LW1lL2FwcHMvZG9jcy9vcGVucGJyXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ZpbGVuYW1lID0gXCIvdG1wL3d0LW1lL2FwcHMvZG9jcy9vcGVucGJyL3ByZXNldHMuZGF0YS50c1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwgPSBcImZpbGU6Ly8vdG1wL3d0LW1lL2FwcHMvZG9jcy9vcGVucGJyL3ByZXNldHMuZGF0YS50c1wiOy8vIFRoZSBwcmVzZXRzIG91dCBvZiB0aGUgc291cmNlcyBvZiBAZ2xhbnovb3BlbnBiciwgd2l0aCB0aGVpciBpbWFnZXMgd2hlcmUgdGhlcmUgYXJlIGFueS5cbmltcG9ydCB7IGV4aXN0c1N5bmMgfSBmcm9tICdub2RlOmZzJztcbmltcG9ydCB7IGZpbGVVUkxUb1BhdGggfSBmcm9tICdub2RlOnVybCc7XG5pbXBvcnQgdHlwZSB7IE9wZW5QYnJQYXJhbWV0ZXJzIH0gZnJvbSAnQGdsYW56L29wZW5wYnIvcGFyYW1ldGVycyc7XG5pbXBvcnQgeyBkZWZpbmVMb2FkZXIgfSBmcm9tICd2aXRlcHJlc3MnO1xuaW1wb3J0IHsgcmVhZEV4cG9ydCB9IGZyb20gJy4uL3NyYy9yZWFkLWV4cG9ydCc7XG5cbi8qKiBPbmUgcHJlc2V0OiBpdHMgbmFtZSwgaXRzIHBhcmFtZXRlcnMgdG8gcHJpbnQsIGFuZCB0aGUgYWRkcmVzcyBvZiBpdHMgaW1hZ2UuICovXG5pbnRlcmZhY2UgQ2FyZCB7XG4gIHJlYWRvbmx5IG5hbWU6IHN0cmluZztcbiAgcmVhZG9ubHkgdGV4dDogc3RyaW5nO1xuICByZWFkb25seSBpbWFnZTogc3RyaW5nIHwgdW5kZWZpbmVkO1xufVxuXG5kZWNsYXJlIGNvbnN0IGRhdGE6IHJlYWRvbmx5IENhcmRbXTtcbmV4cG9ydCB7IGRhdGEgfTtcblxuY29uc3QgbnVtYmVyID0gKHZhbHVlOiBudW1iZXIpID0+IFN0cmluZyhNYXRoLnJvdW5kKHZhbHVlICogMTAwMCkgLyAxMDAwKTtcbmNvbnN0IHByaW50ID0gKHZhbHVlOiB1bmtub3duKSA9PlxuICBBcnJheS5pc0FycmF5KHZhbHVlKVxuICAgID8gYFske3ZhbHVlLm1hcChudW1iZXIpLmpvaW4oJywgJyl9XWBcbiAgICA6IHR5cGVvZiB2YWx1ZSA9PT0gJ251bWJlcidcbiAgICAgID8gbnVtYmVyKHZhbHVlKVxuICAgICAgOiBTdHJpbmcodmFsdWUpO1xuXG5leHBvcnQgZGVmYXVsdCBkZWZpbmVMb2FkZXIoe1xuICB3YXRjaDogWycuLi8uLi8uLi9wYWNrYWdlcy9vcGVucGJyL3NyYy9wcmVzZXRzLyoudHMnLCAnLi4vcHVibGljL3ByZXNldHMvKi53ZWJwJ10sXG4gIGFzeW5jIGxvYWQoKTogUHJvbWlzZTxyZWFkb25seSBDYXJkW10+IHtcbiAgICBjb25zdCBwcmVzZXRzID0gKGF3YWl0IHJlYWRFeHBvcnQoJ0BnbGFuei9vcGVucGJyL3ByZXNldHMnLCAnT1BFTlBCUl9QUkVTRVRTJykpIGFzIFJlY29yZDxcbiAgICAgIHN0cmluZyxcbiAgICAgIFBhcnRpYWw8T3BlblBiclBhcmFtZXRlcnM+XG4gICAgPjtcbiAgICByZXR1cm4gT2JqZWN0LmVudHJpZXMocHJlc2V0cykubWFwKChbbmFtZSwgcGFyYW1ldGVyc10pID0+ICh7XG4gICAgICBuYW1lLFxuICAgICAgdGV4dDogT2JqZWN0LmVudHJpZXMocGFyYW1ldGVycylcbiAgICAgICAgLm1hcCgoW2tleSwgdmFsdWVdKSA9PiBgJHtrZXl9OiAke3ByaW50KHZhbHVlKX1gKVxuICAgICAgICAuam9pbignXFxuJyksXG4gICAgICBpbWFnZTogZXhpc3RzU3luYyhmaWxlVVJMVG9QYXRoKG5ldyBVUkwoYC4uL3B1YmxpYy9wcmVzZXRzLyR7bmFtZX0ud2VicGAsIGltcG9ydC5tZXRhLnVybCkpKVxuICAgICAgICA/IGAvcHJlc2V0cy8ke25hbWV9LndlYnBgXG4gICAgICAgIDogdW5kZWZpbmVkLFxuICAgIH0pKTtcbiAgfSxcbn0pO1xuIiwgImNvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9kaXJuYW1lID0gXCIvdG1wL3d0LW1lL2FwcHMvZG9jcy9zcmNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZmlsZW5hbWUgPSBcIi90bXAvd3QtbWUvYXBwcy9kb2NzL3NyYy9yZWFkLWV4cG9ydC50c1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwgPSBcImZpbGU6Ly8vdG1wL3d0LW1lL2FwcHMvZG9jcy9zcmMvcmVhZC1leHBvcnQudHNcIjtpbXBvcnQgeyBmaWxlVVJMVG9QYXRoIH0gZnJvbSAnbm9kZTp1cmwnO1xuaW1wb3J0IHsgYnVpbGQgfSBmcm9tICdlc2J1aWxkJztcbmltcG9ydCB7IHdlc2xTb3VyY2UgfSBmcm9tICcuLi8uLi8uLi90b29scy9waXBlbGluZS93ZXNsLm1qcyc7XG5cbi8qKlxuICogRXZhbHVhdGVzIG9uZSBleHBvcnQgb2YgYSBtb2R1bGUgb2YgdGhpcyByZXBvc2l0b3J5LCBmcm9tIHNvdXJjZXMsIGF0IGJ1aWxkIHRpbWU6IHBhZ2VzIHRoYXQgdGVsbCBhYm91dCBjb2RlIHJlYWQgaXRcbiAqIGluc3RlYWQgb2YgY29weWluZyBpdC5cbiAqXG4gKiBAcGFyYW0gc3BlY2lmaWVyIEEgcGFja2FnZSBlbnRyeSwgb3IgYSBwYXRoIHJlbGF0aXZlIHRvIHRoaXMgZm9sZGVyLlxuICovXG5leHBvcnQgYXN5bmMgZnVuY3Rpb24gcmVhZEV4cG9ydChzcGVjaWZpZXI6IHN0cmluZywgbmFtZTogc3RyaW5nKTogUHJvbWlzZTx1bmtub3duPiB7XG4gIGNvbnN0IHsgb3V0cHV0RmlsZXMgfSA9IGF3YWl0IGJ1aWxkKHtcbiAgICBzdGRpbjoge1xuICAgICAgY29udGVudHM6IGBleHBvcnQgeyAke25hbWV9IGFzIHZhbHVlIH0gZnJvbSAnJHtzcGVjaWZpZXJ9JztgLFxuICAgICAgcmVzb2x2ZURpcjogZmlsZVVSTFRvUGF0aChuZXcgVVJMKCcuJywgaW1wb3J0Lm1ldGEudXJsKSksXG4gICAgfSxcbiAgICBjb25kaXRpb25zOiBbJ0BnbGFuei9zb3VyY2UnXSxcbiAgICBidW5kbGU6IHRydWUsXG4gICAgZm9ybWF0OiAnZXNtJyxcbiAgICBwbGF0Zm9ybTogJ25ldXRyYWwnLFxuICAgIHBsdWdpbnM6IFt3ZXNsU291cmNlKCldLFxuICAgIHdyaXRlOiBmYWxzZSxcbiAgfSk7XG4gIGNvbnN0IHsgdmFsdWUgfSA9IChhd2FpdCBpbXBvcnQoXG4gICAgYGRhdGE6dGV4dC9qYXZhc2NyaXB0O2Jhc2U2NCwke0J1ZmZlci5mcm9tKG91dHB1dEZpbGVzWzBdIS5jb250ZW50cykudG9TdHJpbmcoJ2Jhc2U2NCcpfWBcbiAgKSkgYXMgeyB2YWx1ZTogdW5rbm93biB9O1xuICByZXR1cm4gdmFsdWU7XG59XG4iLCAiY29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2Rpcm5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmVcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZmlsZW5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC5tanNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfaW1wb3J0X21ldGFfdXJsID0gXCJmaWxlOi8vL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLm1qc1wiOy8vIFNoYWRlciBzb3VyY2UgaW4gV0VTTCAoaHR0cHM6Ly93ZXNsLWxhbmcuZGV2KSwgdHVybmVkIGludG8gdGhlIG1vZHVsZXMgdGhhdCBAZ2xhbnovd2dzbCBjb21wb3NlcyBhdCBydW4gdGltZS5cbi8vXG4vLyBgaW1wb3J0IHBhY2thZ2U6OmE6OmI6Om5hbWU7YCBiZWNvbWVzIGEgZGVwZW5kZW5jeSwgYEBpZihGTEFHKSBcdTIwMjYgQGVsaWYoRkxBRykgXHUyMDI2IEBlbHNlIFx1MjAyNmAgb24gZGVjbGFyYXRpb25zLCBtZW1iZXJzLFxuLy8gcGFyYW1ldGVycywgc3RhdGVtZW50cyBhbmQgaW1wb3J0cyBiZWNvbWVzIGdhdGVzLiBOb3RoaW5nIGVsc2UgY2hhbmdlcywgYW5kIGV2ZXJ5IGxpbmUga2VlcHMgaXRzIG51bWJlcjogbGluZSBuIG9mIGFcbi8vIG1vZHVsZSdzIHRleHQgaXMgbGluZSBuIG9mIGl0cyBmaWxlLiBObyBwYXJzZXIgb2YgV0VTTCBpcyBpbiB3aGF0IHdlIHB1Ymxpc2guXG4vL1xuLy8gQSBmaWxlIG9mIGNvbnN0YW50cyBpcyBUeXBlU2NyaXB0J3MgdG9vOiBzZWUgd2VzbC1jb25zdGFudHMubWpzLlxuaW1wb3J0IHsgZXhpc3RzU3luYywgcmVhZEZpbGVTeW5jIH0gZnJvbSAnbm9kZTpmcyc7XG5pbXBvcnQgeyBkaXJuYW1lLCBqb2luLCByZWxhdGl2ZSwgcmVzb2x2ZSwgc2VwIH0gZnJvbSAnbm9kZTpwYXRoJztcbmltcG9ydCB7IGV4cG9ydGVkQ29uc3RhbnRzLCByZWFkQ29uc3RhbnRzIH0gZnJvbSAnLi93ZXNsLWNvbnN0YW50cy5tanMnO1xuaW1wb3J0IHsgc2hvcnRlbkxvY2FscyB9IGZyb20gJy4vd2VzbC1uYW1lcy5tanMnO1xuaW1wb3J0IHsgV2VzbEVycm9yLCB0b2tlbml6ZSB9IGZyb20gJy4vd2VzbC10b2tlbnMubWpzJztcblxuZXhwb3J0IHsgV2VzbEVycm9yIH07XG5cbmNvbnN0IENMT1NJTkcgPSB7ICcoJzogJyknLCAnWyc6ICddJywgJ3snOiAnfScsICc8JzogJz4nIH07XG5cbi8qKlxuICogUmVhZHMgYSBXRVNMIGZpbGUuXG4gKlxuICogQHBhcmFtIHtzdHJpbmd9IHRleHRcbiAqIEBwYXJhbSB7c3RyaW5nfSBmaWxlIEZvciBtZXNzYWdlcy5cbiAqIEByZXR1cm5zIHt7IGltcG9ydHM6IHsgcGF0aDogc3RyaW5nW10sIG5hbWU6IHN0cmluZywgZmxhZzogc3RyaW5nIHwgdW5kZWZpbmVkLCBsaW5lOiBudW1iZXIgfVtdLCBlZGl0czogeyBmcm9tOlxuICogICBudW1iZXIsIHRvOiBudW1iZXIsIHRleHQ6IHN0cmluZyB9W10sIGNvbW1lbnRzOiB7IGZyb206IG51bWJlciwgdG86IG51bWJlciB9W10sIHRva2VuczogeyB0ZXh0OiBzdHJpbmcsIGZyb206IG51bWJlcixcbiAqICAgdG86IG51bWJlciB9W10gfX0gYGVkaXRzYCB0dXJuIHRoZSB0ZXh0IGludG8gb25lIHdpdGggZ2F0ZXMuIGBwYXRoYCBpcyB0aGUgbW9kdWxlIG9mIGFuIGltcG9ydGVkIG5hbWUuXG4gKiBAdGhyb3dzIHtXZXNsRXJyb3J9XG4gKi9cbmV4cG9ydCBmdW5jdGlvbiBwYXJzZVdlc2wodGV4dCwgZmlsZSA9ICdtb2R1bGUud2VzbCcpIHtcbiAgY29uc3QgZmFpbCA9IChhdCwgbWVzc2FnZSkgPT4ge1xuICAgIHRocm93IG5ldyBXZXNsRXJyb3IoYCR7ZmlsZX06JHt0ZXh0LnNsaWNlKDAsIGF0KS5zcGxpdCgnXFxuJykubGVuZ3RofTogJHttZXNzYWdlfS5gKTtcbiAgfTtcbiAgY29uc3QgeyB0b2tlbnMsIGNvbW1lbnRzIH0gPSB0b2tlbml6ZSh0ZXh0LCBmYWlsKTtcbiAgY29uc3QgaW1wb3J0cyA9IFtdO1xuICBjb25zdCBlZGl0cyA9IFtdO1xuICBsZXQgbmV4dCA9IDA7XG4gIGNvbnN0IHBlZWsgPSAoKSA9PiB0b2tlbnNbbmV4dF0/LnRleHQ7XG4gIGNvbnN0IGhlcmUgPSAoKSA9PiB0b2tlbnNbbmV4dF0/LmZyb20gPz8gdGV4dC5sZW5ndGg7XG4gIGNvbnN0IHRha2UgPSAoZXhwZWN0ZWQpID0+IHtcbiAgICBjb25zdCB0b2tlbiA9IHRva2Vuc1tuZXh0XTtcbiAgICBpZiAoIXRva2VuKSByZXR1cm4gZmFpbCh0ZXh0Lmxlbmd0aCwgZXhwZWN0ZWQgPyBgXCIke2V4cGVjdGVkfVwiIGlzIG1pc3NpbmcgYXQgdGhlIGVuZGAgOiAndGhlIGZpbGUgZW5kcyB0b28gc29vbicpO1xuICAgIGlmIChleHBlY3RlZCAhPT0gdW5kZWZpbmVkICYmIHRva2VuLnRleHQgIT09IGV4cGVjdGVkKVxuICAgICAgZmFpbCh0b2tlbi5mcm9tLCBgXCIke3Rva2VuLnRleHR9XCIgc3RhbmRzIHdoZXJlIFwiJHtleHBlY3RlZH1cIiBpcyBleHBlY3RlZGApO1xuICAgIG5leHQrKztcbiAgICByZXR1cm4gdG9rZW47XG4gIH07XG4gIGNvbnN0IGVuZE9mTGFzdCA9ICgpID0+IHRva2Vuc1tuZXh0IC0gMV0udG87XG5cbiAgLyoqIFNraXBzIHRoZSBicmFja2V0IHRoYXQgaXMgbmV4dCwgd2l0aCBhbGwgdGhhdCBpdCBlbmNsb3Nlcy4gKi9cbiAgY29uc3Qgc2tpcEJyYWNrZXQgPSAoKSA9PiB7XG4gICAgY29uc3Qgb3BlbiA9IHRha2UoKTtcbiAgICBmb3IgKGNvbnN0IGNsb3NlID0gQ0xPU0lOR1tvcGVuLnRleHRdOyBwZWVrKCkgIT09IGNsb3NlOykgc2tpcFRva2VuKCk7XG4gICAgdGFrZSgpO1xuICB9O1xuICBjb25zdCBza2lwVG9rZW4gPSAoKSA9PiB7XG4gICAgaWYgKHBlZWsoKSA9PT0gdW5kZWZpbmVkKSBmYWlsKHRleHQubGVuZ3RoLCAndGhlIGZpbGUgZW5kcyBpbnNpZGUgb2YgYSBicmFja2V0Jyk7XG4gICAgaWYgKHBlZWsoKSA9PT0gJ0AnICYmIC9eKGlmfGVsaWZ8ZWxzZSkkLy50ZXN0KHRva2Vuc1tuZXh0ICsgMV0/LnRleHQgPz8gJycpKVxuICAgICAgZmFpbChcbiAgICAgICAgaGVyZSgpLFxuICAgICAgICBgQCR7dG9rZW5zW25leHQgKyAxXS50ZXh0fSBzdGFuZHMgd2hlcmUgbm8gZGVjbGFyYXRpb24sIG1lbWJlciwgcGFyYW1ldGVyLCBzdGF0ZW1lbnQgb3IgaW1wb3J0IGJlZ2luc2AsXG4gICAgICApO1xuICAgIGlmIChwZWVrKCkgaW4gQ0xPU0lORyAmJiBwZWVrKCkgIT09ICc8Jykgc2tpcEJyYWNrZXQoKTtcbiAgICBlbHNlIHRha2UoKTtcbiAgfTtcbiAgY29uc3Qgc2tpcFRvID0gKC4uLmVuZHMpID0+IHtcbiAgICB3aGlsZSAoIWVuZHMuaW5jbHVkZXMocGVlaygpKSkgc2tpcFRva2VuKCk7XG4gIH07XG5cbiAgLyoqIGAoQSAmJiAhQilgIGFzIHRoZSBjb21wb3NlciByZWFkcyBpdCwgYEEmJiFCYC4gKi9cbiAgY29uc3QgY29uZGl0aW9uID0gKCkgPT4ge1xuICAgIGNvbnN0IGZyb20gPSB0YWtlKCcoJykuZnJvbTtcbiAgICBjb25zdCBwYXJ0cyA9IFtdO1xuICAgIGRvIHtcbiAgICAgIGlmIChwYXJ0cy5sZW5ndGggPiAwKSB0YWtlKCcmJicpO1xuICAgICAgbGV0IG5lZ2F0ZWQgPSBmYWxzZTtcbiAgICAgIHdoaWxlIChwZWVrKCkgPT09ICchJykge1xuICAgICAgICB0YWtlKCk7XG4gICAgICAgIG5lZ2F0ZWQgPSAhbmVnYXRlZDtcbiAgICAgIH1cbiAgICAgIGNvbnN0IGZsYWcgPSB0YWtlKCk7XG4gICAgICBpZiAoIS9eW0EtWmEtel9dXFx3KiQvLnRlc3QoZmxhZy50ZXh0KSlcbiAgICAgICAgZmFpbChcbiAgICAgICAgICBmbGFnLmZyb20sXG4gICAgICAgICAgJ2EgY29uZGl0aW9uIGlzIGEgZmxhZywgIWZsYWcsIG9yIHNldmVyYWwgb2YgdGhlbSB3aXRoICYmIGJldHdlZW47IGZvciB8fCB1c2UgYSBmbGFnIHRoYXQgc3RhbmRzIGZvciBib3RoJyxcbiAgICAgICAgKTtcbiAgICAgIHBhcnRzLnB1c2goYCR7bmVnYXRlZCA/ICchJyA6ICcnfSR7ZmxhZy50ZXh0fWApO1xuICAgIH0gd2hpbGUgKHBlZWsoKSA9PT0gJyYmJyk7XG4gICAgaWYgKHBlZWsoKSAhPT0gJyknKVxuICAgICAgZmFpbChcbiAgICAgICAgZnJvbSxcbiAgICAgICAgJ2EgY29uZGl0aW9uIGlzIGEgZmxhZywgIWZsYWcsIG9yIHNldmVyYWwgb2YgdGhlbSB3aXRoICYmIGJldHdlZW47IGZvciB8fCB1c2UgYSBmbGFnIHRoYXQgc3RhbmRzIGZvciBib3RoJyxcbiAgICAgICk7XG4gICAgdGFrZSgnKScpO1xuICAgIHJldHVybiBwYXJ0cy5qb2luKCcmJicpO1xuICB9O1xuXG4gIC8qKiBUaGUgYXR0cmlidXRlcyBiZWZvcmUgYW4gZWxlbWVudDsgYXQgbW9zdCBvbmUgb2YgdGhlbSBpcyBhIGdhdGUuICovXG4gIGNvbnN0IGF0dHJpYnV0ZXMgPSAoKSA9PiB7XG4gICAgbGV0IGdhdGU7XG4gICAgd2hpbGUgKHBlZWsoKSA9PT0gJ0AnKSB7XG4gICAgICBjb25zdCB7IGZyb20gfSA9IHRha2UoJ0AnKTtcbiAgICAgIGNvbnN0IG5hbWUgPSB0YWtlKCk7XG4gICAgICBpZiAoL14oaWZ8ZWxpZnxlbHNlKSQvLnRlc3QobmFtZS50ZXh0KSkge1xuICAgICAgICBpZiAoZ2F0ZSkgZmFpbChmcm9tLCAnYW4gZWxlbWVudCBoYXMgdHdvIGNvbmRpdGlvbnM6IGpvaW4gdGhlbSBieSAmJicpO1xuICAgICAgICBnYXRlID0geyBraW5kOiBuYW1lLnRleHQsIGZyb20sIGNvbmRpdGlvbjogbmFtZS50ZXh0ID09PSAnZWxzZScgPyB1bmRlZmluZWQgOiBjb25kaXRpb24oKSwgdG86IDAgfTtcbiAgICAgICAgZ2F0ZS50byA9IGVuZE9mTGFzdCgpO1xuICAgICAgfSBlbHNlIGlmIChwZWVrKCkgPT09ICcoJykgc2tpcEJyYWNrZXQoKTtcbiAgICB9XG4gICAgcmV0dXJuIGdhdGU7XG4gIH07XG5cbiAgY29uc3QgaW1wb3J0VHJlZSA9IChwYXRoKSA9PiB7XG4gICAgY29uc3QgZm91bmQgPSBbXTtcbiAgICBjb25zdCBicmFuY2ggPSAoYmVmb3JlKSA9PiB7XG4gICAgICBpZiAocGVlaygpID09PSAneycpIHtcbiAgICAgICAgdGFrZSgneycpO1xuICAgICAgICB3aGlsZSAocGVlaygpICE9PSAnfScpIHtcbiAgICAgICAgICBicmFuY2goYmVmb3JlKTtcbiAgICAgICAgICBpZiAocGVlaygpICE9PSAnfScpIHRha2UoJywnKTtcbiAgICAgICAgfVxuICAgICAgICB0YWtlKCd9Jyk7XG4gICAgICAgIHJldHVybjtcbiAgICAgIH1cbiAgICAgIGNvbnN0IG5hbWUgPSB0YWtlKCk7XG4gICAgICBpZiAoIS9eW0EtWmEtel9dXFx3KiQvLnRlc3QobmFtZS50ZXh0KSkgZmFpbChuYW1lLmZyb20sIGBcIiR7bmFtZS50ZXh0fVwiIGlzIG5vIG5hbWUgdG8gaW1wb3J0YCk7XG4gICAgICBpZiAocGVlaygpID09PSAnOjonKSB7XG4gICAgICAgIHRha2UoJzo6Jyk7XG4gICAgICAgIGJyYW5jaChbLi4uYmVmb3JlLCBuYW1lLnRleHRdKTtcbiAgICAgIH0gZWxzZSBpZiAocGVlaygpID09PSAnYXMnKSBmYWlsKGhlcmUoKSwgJ2ltcG9ydHMgY2Fubm90IGJlIHJlbmFtZWQ6IG5hbWVzIGFyZSB1bmlxdWUgaW4gYWxsIG9mIHRoZSBwcm9qZWN0Jyk7XG4gICAgICBlbHNlIGZvdW5kLnB1c2goeyBwYXRoOiBiZWZvcmUsIG5hbWU6IG5hbWUudGV4dCwgYXQ6IG5hbWUuZnJvbSB9KTtcbiAgICB9O1xuICAgIGJyYW5jaChwYXRoKTtcbiAgICByZXR1cm4gZm91bmQ7XG4gIH07XG5cbiAgY29uc3QgaW1wb3J0U3RhdGVtZW50ID0gKGZyb20sIGdhdGUpID0+IHtcbiAgICBpZiAoZ2F0ZSAmJiAoZ2F0ZS5raW5kICE9PSAnaWYnIHx8IGdhdGUuY29uZGl0aW9uLmluY2x1ZGVzKCcmJykpKVxuICAgICAgZmFpbChmcm9tLCAnYW4gaW1wb3J0IGlzIGdhdGVkIGJ5IEBpZihGTEFHKSBvciBAaWYoIUZMQUcpJyk7XG4gICAgdGFrZSgnaW1wb3J0Jyk7XG4gICAgZm9yIChjb25zdCB7IHBhdGgsIG5hbWUsIGF0IH0gb2YgaW1wb3J0VHJlZShbXSkpIHtcbiAgICAgIGlmIChwYXRoLmxlbmd0aCA9PT0gMCkgZmFpbChhdCwgYFwiaW1wb3J0ICR7bmFtZX1cIiBuYW1lcyBubyBtb2R1bGVgKTtcbiAgICAgIGltcG9ydHMucHVzaCh7IHBhdGgsIG5hbWUsIGZsYWc6IGdhdGU/LmNvbmRpdGlvbiwgbGluZTogdGV4dC5zbGljZSgwLCBhdCkuc3BsaXQoJ1xcbicpLmxlbmd0aCB9KTtcbiAgICB9XG4gICAgdGFrZSgnOycpO1xuICAgIC8vIExpbmUgYnJlYWtzIHN0YXkuXG4gICAgZWRpdHMucHVzaCh7IGZyb20sIHRvOiBlbmRPZkxhc3QoKSwgdGV4dDogdGV4dC5zbGljZShmcm9tLCBlbmRPZkxhc3QoKSkucmVwbGFjZSgvW15cXG5dKy9nLCAnJykgfSk7XG4gIH07XG5cbiAgY29uc3QgYmxvY2sgPSAoKSA9PiB7XG4gICAgdGFrZSgneycpO1xuICAgIHNlcXVlbmNlKHN0YXRlbWVudCwgJ30nKTtcbiAgICB0YWtlKCd9Jyk7XG4gIH07XG5cbiAgY29uc3QgZGVjbGFyYXRpb24gPSAoKSA9PiB7XG4gICAgaWYgKHBlZWsoKSA9PT0gJ2ZuJykge1xuICAgICAgdGFrZSgpO1xuICAgICAgdGFrZSgpO1xuICAgICAgdGFrZSgnKCcpO1xuICAgICAgc2VxdWVuY2UobGlzdGVkKCcpJyksICcpJyk7XG4gICAgICB0YWtlKCcpJyk7XG4gICAgICBza2lwVG8oJ3snKTtcbiAgICAgIGJsb2NrKCk7XG4gICAgfSBlbHNlIGlmIChwZWVrKCkgPT09ICdzdHJ1Y3QnKSB7XG4gICAgICB0YWtlKCk7XG4gICAgICB0YWtlKCk7XG4gICAgICB0YWtlKCd7Jyk7XG4gICAgICBzZXF1ZW5jZShsaXN0ZWQoJ30nKSwgJ30nKTtcbiAgICAgIHRha2UoJ30nKTtcbiAgICAgIGlmIChwZWVrKCkgPT09ICc7JykgdGFrZSgpO1xuICAgIH0gZWxzZSB7XG4gICAgICBpZiAocGVlaygpICE9PSAnOycpIHNraXBUbygnOycpO1xuICAgICAgdGFrZSgnOycpO1xuICAgIH1cbiAgfTtcblxuICAvKiogQSBtZW1iZXIgb2YgYSBzdHJ1Y3Qgb3IgYSBwYXJhbWV0ZXIuICovXG4gIGNvbnN0IGxpc3RlZCA9IChjbG9zZSkgPT4gKCkgPT4ge1xuICAgIGxldCBkZXB0aCA9IDA7XG4gICAgd2hpbGUgKGRlcHRoID4gMCB8fCAocGVlaygpICE9PSAnLCcgJiYgcGVlaygpICE9PSBjbG9zZSkpIHtcbiAgICAgIGlmIChwZWVrKCkgPT09ICc8JykgZGVwdGgrKztcbiAgICAgIGlmIChwZWVrKCkgPT09ICc+JykgZGVwdGgtLTtcbiAgICAgIHNraXBUb2tlbigpO1xuICAgIH1cbiAgICBpZiAocGVlaygpID09PSAnLCcpIHRha2UoKTtcbiAgfTtcblxuICBjb25zdCBjbGF1c2UgPSAoKSA9PiB7XG4gICAgaWYgKHBlZWsoKSAhPT0gJ2Nhc2UnICYmIHBlZWsoKSAhPT0gJ2RlZmF1bHQnKSBmYWlsKGhlcmUoKSwgYFwiJHtwZWVrKCl9XCIgc3RhbmRzIHdoZXJlIGEgY2FzZSBpcyBleHBlY3RlZGApO1xuICAgIHNraXBUbygneycpO1xuICAgIGJsb2NrKCk7XG4gIH07XG5cbiAgY29uc3Qgc3RhdGVtZW50ID0gKCkgPT4ge1xuICAgIHN3aXRjaCAocGVlaygpKSB7XG4gICAgICBjYXNlICd7JzpcbiAgICAgICAgcmV0dXJuIGJsb2NrKCk7XG4gICAgICBjYXNlICdpZic6XG4gICAgICBjYXNlICdmb3InOlxuICAgICAgY2FzZSAnd2hpbGUnOlxuICAgICAgICB0YWtlKCk7XG4gICAgICAgIHNraXBUbygneycpO1xuICAgICAgICBibG9jaygpO1xuICAgICAgICB3aGlsZSAocGVlaygpID09PSAnZWxzZScpIHtcbiAgICAgICAgICB0YWtlKCk7XG4gICAgICAgICAgc2tpcFRvKCd7Jyk7XG4gICAgICAgICAgYmxvY2soKTtcbiAgICAgICAgfVxuICAgICAgICByZXR1cm4gdW5kZWZpbmVkO1xuICAgICAgY2FzZSAnbG9vcCc6XG4gICAgICBjYXNlICdjb250aW51aW5nJzpcbiAgICAgICAgdGFrZSgpO1xuICAgICAgICBza2lwVG8oJ3snKTtcbiAgICAgICAgcmV0dXJuIGJsb2NrKCk7XG4gICAgICBjYXNlICdzd2l0Y2gnOlxuICAgICAgICB0YWtlKCk7XG4gICAgICAgIHNraXBUbygneycpO1xuICAgICAgICB0YWtlKCd7Jyk7XG4gICAgICAgIHNlcXVlbmNlKGNsYXVzZSwgJ30nKTtcbiAgICAgICAgdGFrZSgnfScpO1xuICAgICAgICByZXR1cm4gdW5kZWZpbmVkO1xuICAgICAgZGVmYXVsdDpcbiAgICAgICAgc2tpcFRvKCc7JywgJ30nKTtcbiAgICAgICAgdGFrZSgnOycpO1xuICAgICAgICByZXR1cm4gdW5kZWZpbmVkO1xuICAgIH1cbiAgfTtcblxuICAvKiogRWxlbWVudHMgdXAgdG8gYSBjbG9zaW5nIGJyYWNrZXQsIG9yIHRvIHRoZSBlbmQgb2YgdGhlIGZpbGUsIHdpdGggdGhlaXIgY2hhaW5zIG9mIGNvbmRpdGlvbnMuICovXG4gIGNvbnN0IHNlcXVlbmNlID0gKGVsZW1lbnQsIGNsb3NlKSA9PiB7XG4gICAgLy8gSG93IG1hbnkgZ2F0ZXMgb2YgdGhlIGNoYWluIGFyZSBvcGVuLCBhbmQgdGhlIGNvbmRpdGlvbiBvZiBhIGNoYWluIHRoYXQgaXMgb25lIEBpZiBhbG9uZS5cbiAgICBsZXQgb3BlbiA9IDA7XG4gICAgbGV0IGVuZCA9IDA7XG4gICAgbGV0IGFsb25lO1xuICAgIGNvbnN0IGNsb3NlQ2hhaW4gPSAoKSA9PiB7XG4gICAgICBpZiAob3BlbiA+IDApXG4gICAgICAgIGVkaXRzLnB1c2goeyBmcm9tOiBlbmQsIHRvOiBlbmQsIHRleHQ6IGAkeycvLyNlbmRpZicucmVwZWF0KG9wZW4pfSR7L1xcdy8udGVzdCh0ZXh0W2VuZF0gPz8gJycpID8gJyAnIDogJyd9YCB9KTtcbiAgICAgIG9wZW4gPSAwO1xuICAgICAgYWxvbmUgPSB1bmRlZmluZWQ7XG4gICAgfTtcbiAgICB3aGlsZSAocGVlaygpICE9PSBjbG9zZSkge1xuICAgICAgaWYgKHBlZWsoKSA9PT0gdW5kZWZpbmVkKSBmYWlsKHRleHQubGVuZ3RoLCBgXCIke2Nsb3NlfVwiIGlzIG1pc3NpbmcgYXQgdGhlIGVuZGApO1xuICAgICAgY29uc3QgZnJvbSA9IGhlcmUoKTtcbiAgICAgIGNvbnN0IGdhdGUgPSBhdHRyaWJ1dGVzKCk7XG4gICAgICAvLyBOZWlnaGJvdXJzIG9mIG9uZSBjb25kaXRpb24gc2hhcmUgYSBnYXRlLlxuICAgICAgY29uc3Qgc2hhcmVkID0gZ2F0ZT8ua2luZCA9PT0gJ2lmJyAmJiBnYXRlLmNvbmRpdGlvbiA9PT0gYWxvbmUgJiYgcGVlaygpICE9PSAnaW1wb3J0JztcbiAgICAgIGlmICgoIWdhdGUgfHwgZ2F0ZS5raW5kID09PSAnaWYnKSAmJiAhc2hhcmVkKSBjbG9zZUNoYWluKCk7XG4gICAgICBpZiAocGVlaygpID09PSAnaW1wb3J0JyAmJiBjbG9zZSA9PT0gdW5kZWZpbmVkKSB7XG4gICAgICAgIGltcG9ydFN0YXRlbWVudChmcm9tLCBnYXRlKTtcbiAgICAgICAgY29udGludWU7XG4gICAgICB9XG4gICAgICBpZiAoZ2F0ZSkge1xuICAgICAgICBpZiAoZ2F0ZS5raW5kICE9PSAnaWYnICYmIG9wZW4gPT09IDApIGZhaWwoZ2F0ZS5mcm9tLCBgQCR7Z2F0ZS5raW5kfSB3aXRob3V0IEBpZiBiZWZvcmUgaXRgKTtcbiAgICAgICAgY29uc3Qgc3RhcnQgPSBnYXRlLmtpbmQgPT09ICdpZicgPyAnJyA6ICcvLyNlbHNlJztcbiAgICAgICAgY29uc3QgZ2FwID0gL1xccy8udGVzdCh0ZXh0W2dhdGUudG9dID8/ICcgJykgPyAnJyA6ICcgJztcbiAgICAgICAgY29uc3QgbWFya3MgPSBzaGFyZWQgPyAnJyA6IGAke3N0YXJ0fSR7Z2F0ZS5jb25kaXRpb24gPT09IHVuZGVmaW5lZCA/ICcnIDogYC8vI2lmICR7Z2F0ZS5jb25kaXRpb259YH1gO1xuICAgICAgICBlZGl0cy5wdXNoKHsgZnJvbTogZ2F0ZS5mcm9tLCB0bzogZ2F0ZS50bywgdGV4dDogYCR7bWFya3N9JHtnYXB9YCB9KTtcbiAgICAgICAgaWYgKGdhdGUuY29uZGl0aW9uICE9PSB1bmRlZmluZWQgJiYgIXNoYXJlZCkgb3BlbisrO1xuICAgICAgICBhbG9uZSA9IGdhdGUua2luZCA9PT0gJ2lmJyA/IGdhdGUuY29uZGl0aW9uIDogdW5kZWZpbmVkO1xuICAgICAgfVxuICAgICAgZWxlbWVudCgpO1xuICAgICAgZW5kID0gZW5kT2ZMYXN0KCk7XG4gICAgICBpZiAoZ2F0ZT8ua2luZCA9PT0gJ2Vsc2UnKSBjbG9zZUNoYWluKCk7XG4gICAgfVxuICAgIGNsb3NlQ2hhaW4oKTtcbiAgfTtcblxuICBzZXF1ZW5jZShkZWNsYXJhdGlvbiwgdW5kZWZpbmVkKTtcbiAgZm9yIChjb25zdCB7IGZyb20sIHRvIH0gb2YgY29tbWVudHMpXG4gICAgaWYgKHRleHQuc2xpY2UoZnJvbSwgdG8pLmluY2x1ZGVzKCcvLyMnKSkgZmFpbChmcm9tLCAnYSBjb21tZW50IG11c3Qgbm90IGhvbGQgXCIvLyNcIiwgd2hpY2ggbWFya3MgZ2F0ZXMnKTtcbiAgcmV0dXJuIHsgaW1wb3J0cywgZWRpdHMsIGNvbW1lbnRzLCB0b2tlbnMgfTtcbn1cblxuY29uc3QgT1BFUkFUT1IgPSAvWy0rKi8lPTw+ISZ8Xn5dLztcblxuLyoqXG4gKiBBIGxpbmUgb2YgV0dTTCB3aXRob3V0IHRoZSBzcGFjZXMgdGhhdCBzZXBhcmF0ZSBub3RoaW5nOiB0aG9zZSBiZXNpZGUgcHVuY3R1YXRpb24uIEJldHdlZW4gdHdvIG9wZXJhdG9ycyB0aGV5IHN0YXksXG4gKiBmb3IgYGEgLSAtYmAgYW5kIGBhcnJheTxmMzI+ID0geGAgbWVhbiBzb21ldGhpbmcgZWxzZSB3aXRob3V0IHRoZW0uIExpbmVzIHdpdGggY29tbWVudHMgc3RheSBhcyB0aGV5IGFyZS5cbiAqL1xuZXhwb3J0IGZ1bmN0aW9uIGNsb3NlVXAobGluZSkge1xuICBpZiAobGluZS5pbmNsdWRlcygnLy8nKSkgcmV0dXJuIGxpbmU7XG4gIGNvbnN0IGNsb3NlZCA9IGxpbmUucmVwbGFjZSgvKD88PShcXFMpKSArKD89KFxcUykpL2csIChzcGFjZXMsIGJlZm9yZSwgYWZ0ZXIpID0+IHtcbiAgICBjb25zdCBzZXBhcmF0ZXMgPSAvXFx3Ly50ZXN0KGJlZm9yZSkgJiYgL1xcdy8udGVzdChhZnRlcik7XG4gICAgcmV0dXJuIHNlcGFyYXRlcyB8fCAoT1BFUkFUT1IudGVzdChiZWZvcmUpICYmIE9QRVJBVE9SLnRlc3QoYWZ0ZXIpKSA/IHNwYWNlcyA6ICcnO1xuICB9KTtcbiAgLy8gMS4wIGlzIDEuIGFuZCAwLjUgaXMgLjU7IHdoYXQgYSBzdWJzdGl0dXRpb24gbWF5IGdvIG9uIHdpdGggc3RheXMuXG4gIHJldHVybiBjbG9zZWQucmVwbGFjZSgvKD88PVxcZFxcLikwKD89W15cXHcuXSkvZywgJycpLnJlcGxhY2UoLyg/PCFbXFx3Ll0pMCg/PVxcLlxcZCkvZywgJycpO1xufVxuXG4vKiogQSBsaW5lIHdpdGggZ2F0ZXMsIHdpdGhvdXQgdGhlIHNwYWNlcyB0aGF0IHNlcGFyYXRlIG5vdGhpbmcuICovXG5jb25zdCBjbG9zZVVwR2F0ZWQgPSAobGluZSkgPT5cbiAgbGluZVxuICAgIC5zcGxpdCgvKFxcL1xcLyMoPzppZiBbXFx3ISZdK3xlbHNlfGVuZGlmKSkvKVxuICAgIC5tYXAoKHBhcnQsIGkpID0+IHtcbiAgICAgIGlmIChpICUgMikgcmV0dXJuIHBhcnQ7XG4gICAgICBjb25zdCBzaHV0ID0gY2xvc2VVcChwYXJ0LnRyaW0oKSk7XG4gICAgICByZXR1cm4gaSA+IDAgJiYgL15cXHcvLnRlc3Qoc2h1dCkgPyBgICR7c2h1dH1gIDogc2h1dDtcbiAgICB9KVxuICAgIC5qb2luKCcnKTtcblxuZnVuY3Rpb24gYXBwbHkodGV4dCwgZWRpdHMpIHtcbiAgbGV0IHJlc3VsdCA9IHRleHQ7XG4gIGZvciAoY29uc3QgZWRpdCBvZiBbLi4uZWRpdHNdLnNvcnQoKGEsIGIpID0+IGIuZnJvbSAtIGEuZnJvbSB8fCBiLnRvIC0gYS50bykpXG4gICAgcmVzdWx0ID0gcmVzdWx0LnNsaWNlKDAsIGVkaXQuZnJvbSkgKyBlZGl0LnRleHQgKyByZXN1bHQuc2xpY2UoZWRpdC50byk7XG4gIHJldHVybiByZXN1bHQ7XG59XG5cbi8qKlxuICogVGhlIHRleHQgd2l0aCBnYXRlcyBmb3IgdGhlIGNvbXBvc2VyLCBsaW5lIGJ5IGxpbmUgdGhhdCBvZiB0aGUgZmlsZS4gQHBhcmFtIHtib29sZWFufSBzaHJpbmsgV2l0aG91dCBjb21tZW50cyBhbmRcbiAqIHNwYWNlcyB0aGF0IHNlcGFyYXRlIG5vdGhpbmcsIGFuZCB3aXRoIHNob3J0IG5hbWVzIGluIGZ1bmN0aW9ucy5cbiAqL1xuZnVuY3Rpb24gZ2F0ZWRUZXh0KHRleHQsIHsgZWRpdHMsIGNvbW1lbnRzLCB0b2tlbnMgfSwgc2hyaW5rKSB7XG4gIGlmICghc2hyaW5rKSByZXR1cm4gYXBwbHkodGV4dCwgZWRpdHMpO1xuICBjb25zdCBiYXJlID0gYXBwbHkodGV4dCwgW1xuICAgIC4uLmVkaXRzLFxuICAgIC4uLnNob3J0ZW5Mb2NhbHModG9rZW5zKSxcbiAgICAuLi5jb21tZW50cy5tYXAoKHsgZnJvbSwgdG8gfSkgPT4gKHsgZnJvbSwgdG8sIHRleHQ6IHRleHQuc2xpY2UoZnJvbSwgdG8pLnJlcGxhY2UoL1teXFxuXSsvZywgJycpIHx8ICcgJyB9KSksXG4gIF0pO1xuICByZXR1cm4gYmFyZS5zcGxpdCgnXFxuJykubWFwKGNsb3NlVXBHYXRlZCkuam9pbignXFxuJyk7XG59XG5cbi8qKiBUaGUgbmVhcmVzdCBmb2xkZXIgd2l0aCBhIHBhY2thZ2UuanNvbiwgYW5kIGl0cyBuYW1lIHdpdGhvdXQgdGhlIHNjb3BlLiAqL1xuZnVuY3Rpb24gcGFja2FnZU9mKGZpbGUpIHtcbiAgZm9yIChsZXQgZm9sZGVyID0gZGlybmFtZShmaWxlKTsgZm9sZGVyICE9PSBkaXJuYW1lKGZvbGRlcik7IGZvbGRlciA9IGRpcm5hbWUoZm9sZGVyKSkge1xuICAgIGNvbnN0IG1hbmlmZXN0ID0gam9pbihmb2xkZXIsICdwYWNrYWdlLmpzb24nKTtcbiAgICBpZiAoZXhpc3RzU3luYyhtYW5pZmVzdCkpXG4gICAgICByZXR1cm4geyBmb2xkZXIsIHNob3J0OiBKU09OLnBhcnNlKHJlYWRGaWxlU3luYyhtYW5pZmVzdCwgJ3V0ZjgnKSkubmFtZS5zcGxpdCgnLycpLmF0KC0xKSB9O1xuICB9XG4gIHRocm93IG5ldyBXZXNsRXJyb3IoYCR7ZmlsZX06IGl0IGxpZXMgaW4gbm8gcGFja2FnZS5gKTtcbn1cblxuLyoqXG4gKiBXaGV0aGVyIGFuIGltcG9ydGVkIG5hbWUgaXMgYSBudW1iZXI6IHRob3NlIG9mIFR5cGVTY3JpcHQgYXJlIGluIGNhcGl0YWxzLiBJdCBzdGFuZHMgaW4gdGhlIHRleHQgYXMgYSBsaXRlcmFsIHUzMiwgc29cbiAqIHRoYXQgaG9zdHMgYW5kIHNoYWRlcnMgc2hhcmUgb25lIHRhYmxlLlxuICovXG5jb25zdCBpc051bWJlciA9IChuYW1lKSA9PiAvXltBLVpdW0EtWlxcZF0qKD86X1tBLVpcXGRdKykqJC8udGVzdChuYW1lKTtcblxuLyoqIEZpbGVzIHRoYXQgb25seSBkZWNsYXJlIHdoYXQgdGhlIGhvc3Qgb2YgYSBsaWJyYXJ5IHN1cHBsaWVzLCBzbyB0aGF0IGVkaXRvcnMga25vdyBpdC4gKi9cbmV4cG9ydCBjb25zdCBpc0hvc3QgPSAocGF0aCkgPT4gcGF0aC5hdCgtMSkgPT09ICdob3N0JztcblxuLyoqXG4gKiBUaGUgZmlsZSB0aGF0IGFuIGltcG9ydGVkIG1vZHVsZSBpcyBpbi5cbiAqIEByZXR1cm5zIHt7IGZpbGU6IHN0cmluZywgd2VzbDogYm9vbGVhbiB9fSBgd2VzbGAgZmFsc2U6IFR5cGVTY3JpcHQgdGhhdCBleHBvcnRzIGEgbW9kdWxlIGJ5IHRoZSBpbXBvcnRlZCBuYW1lLlxuICogQHRocm93cyB7V2VzbEVycm9yfVxuICovXG5mdW5jdGlvbiByZXNvbHZlTW9kdWxlKHsgcGF0aCwgbmFtZSwgbGluZSB9LCBmaWxlLCBzb3VyY2UpIHtcbiAgY29uc3QgW3Jvb3QsIC4uLnJlc3RdID0gcGF0aDtcbiAgY29uc3QgZm9sZGVyID0gcm9vdCA9PT0gJ3BhY2thZ2UnID8gc291cmNlIDogcm9vdCA9PT0gJ3N1cGVyJyA/IGRpcm5hbWUoZmlsZSkgOiB1bmRlZmluZWQ7XG4gIGlmIChmb2xkZXIgPT09IHVuZGVmaW5lZCkgdGhyb3cgbmV3IFdlc2xFcnJvcihgJHtmaWxlfToke2xpbmV9OiBcIiR7cm9vdH1cIiBpcyBubyByb290IG9mIGEgcGF0aDogcGFja2FnZSBvciBzdXBlci5gKTtcbiAgY29uc3QgYmFzZSA9IHJlc29sdmUoZm9sZGVyLCAuLi5yZXN0KTtcbiAgaWYgKGV4aXN0c1N5bmMoYCR7YmFzZX0ud2VzbGApKSByZXR1cm4geyBmaWxlOiBgJHtiYXNlfS53ZXNsYCwgd2VzbDogdHJ1ZSB9O1xuICBjb25zdCB0eXBlc2NyaXB0ID0gYCR7am9pbihkaXJuYW1lKGJhc2UpLCAocmVzdC5hdCgtMSkgPz8gJycpLnJlcGxhY2VBbGwoJ18nLCAnLScpKX0udHNgO1xuICBpZiAoZXhpc3RzU3luYyh0eXBlc2NyaXB0KSkgcmV0dXJuIHsgZmlsZTogdHlwZXNjcmlwdCwgd2VzbDogZmFsc2UgfTtcbiAgdGhyb3cgbmV3IFdlc2xFcnJvcihcbiAgICBgJHtmaWxlfToke2xpbmV9OiB0aGVyZSBpcyBubyBtb2R1bGUgJHtwYXRoLmpvaW4oJzo6Jyl9IHRvIGltcG9ydCAke25hbWV9IGZyb206IG5laXRoZXIgJHtiYXNlfS53ZXNsIG5vciAke3R5cGVzY3JpcHR9LmAsXG4gICk7XG59XG5cbi8qKlxuICogQSBXRVNMIGZpbGUgYXMgYSBKYXZhU2NyaXB0IG1vZHVsZSB3aG9zZSBkZWZhdWx0IGV4cG9ydCBpcyBpdHMgYFdnc2xNb2R1bGVgLiBJdHMgbmFtZSBpcyBgPHBhY2thZ2U+LzxmaWxlPmAsIHdpdGhcbiAqIGh5cGhlbnMgZm9yIHVuZGVyc2NvcmVzLiBUaGUgY29uc3RhbnRzIG9mIGEgZmlsZSB0aGF0IGhvbGRzIG5vdGhpbmcgZWxzZSBhcmUgZXhwb3J0ZWQgYnkgdGhlaXIgbmFtZXMuXG4gKlxuICogQHBhcmFtIHtzdHJpbmd9IHRleHRcbiAqIEBwYXJhbSB7c3RyaW5nfSBmaWxlIEFic29sdXRlIHBhdGguXG4gKiBAcGFyYW0ge3sgc2hyaW5rPzogYm9vbGVhbiwgcGFnZT86IGJvb2xlYW4gfX0gb3B0aW9ucyBgc2hyaW5rYDogbGVhdmVzIG91dCBjb21tZW50cyBhbmQgc3BhY2VzLCBhbmQgc2hvcnRlbnMgbmFtZXMgaW5cbiAqICAgZnVuY3Rpb25zLCBmb3Igd2hhdCBpcyBwdWJsaXNoZWQuIGBwYWdlYDogZW1wdHkgbGluZXMgdG9vLCBmb3IgYSBwYWdlIHRoYXQgaXMgYnVpbHQsIHdoaWNoIG5hbWVzIG5vIGxpbmVzIG9mIGl0c1xuICogICBzb3VyY2VzLlxuICogQHJldHVybnMge3sgY29kZTogc3RyaW5nLCBtYXA6IHsgdmVyc2lvbjogMywgc291cmNlczogc3RyaW5nW10sIHNvdXJjZXNDb250ZW50OiBzdHJpbmdbXSwgbmFtZXM6IHN0cmluZ1tdLCBtYXBwaW5nczpcbiAqIHN0cmluZyB9IH19XG4gKiBAdGhyb3dzIHtXZXNsRXJyb3J9XG4gKi9cbmV4cG9ydCBmdW5jdGlvbiBjb21waWxlV2VzbCh0ZXh0LCBmaWxlLCB7IHNocmluayA9IGZhbHNlLCBwYWdlID0gZmFsc2UgfSA9IHt9KSB7XG4gIGNvbnN0IHBhcnNlZCA9IHBhcnNlV2VzbCh0ZXh0LCBmaWxlKTtcbiAgY29uc3QgeyBmb2xkZXIsIHNob3J0IH0gPSBwYWNrYWdlT2YoZmlsZSk7XG4gIGNvbnN0IHNvdXJjZSA9IGpvaW4oZm9sZGVyLCAnc3JjJyk7XG4gIGNvbnN0IG5hbWVzID0gbmV3IE1hcCgpO1xuICBjb25zdCBkZXBlbmRlbmNpZXMgPSBuZXcgTWFwKCk7XG4gIGNvbnN0IG51bWJlcnMgPSBuZXcgTWFwKCk7XG4gIGNvbnN0IHVzZWQgPSBuZXcgU2V0KFsnd2dzbE1vZHVsZSddKTtcbiAgbGV0IGltcG9ydHMgPSAnJztcbiAgZm9yIChjb25zdCBlbnRyeSBvZiBwYXJzZWQuaW1wb3J0cykge1xuICAgIGlmIChpc0hvc3QoZW50cnkucGF0aCkpIGNvbnRpbnVlO1xuICAgIGNvbnN0IHsgZmlsZTogdGFyZ2V0LCB3ZXNsIH0gPSByZXNvbHZlTW9kdWxlKGVudHJ5LCBmaWxlLCBzb3VyY2UpO1xuICAgIGNvbnN0IHNwZWNpZmllciA9IGAuLyR7cmVsYXRpdmUoZGlybmFtZShmaWxlKSwgdGFyZ2V0KS5zcGxpdChzZXApLmpvaW4oJy8nKX1gXG4gICAgICAucmVwbGFjZSgvXlxcLlxcL1xcLlxcLlxcLy8sICcuLi8nKVxuICAgICAgLnJlcGxhY2UoL1xcLnRzJC8sICcnKTtcbiAgICBpZiAoIXdlc2wgJiYgaXNOdW1iZXIoZW50cnkubmFtZSkpIHtcbiAgICAgIGlmIChudW1iZXJzLmhhcyhlbnRyeS5uYW1lKSkgY29udGludWU7XG4gICAgICBudW1iZXJzLnNldChlbnRyeS5uYW1lLCBgbnVtYmVyJHtudW1iZXJzLnNpemV9YCk7XG4gICAgICBpbXBvcnRzICs9IGBpbXBvcnQgeyAke2VudHJ5Lm5hbWV9IGFzICR7bnVtYmVycy5nZXQoZW50cnkubmFtZSl9IH0gZnJvbSAke0pTT04uc3RyaW5naWZ5KHNwZWNpZmllcil9O2A7XG4gICAgICBjb250aW51ZTtcbiAgICB9XG4gICAgY29uc3Qga2V5ID0gd2VzbCA/IHNwZWNpZmllciA6IGAke3NwZWNpZmllcn0gJHtlbnRyeS5uYW1lfWA7XG4gICAgbGV0IG5hbWUgPSBuYW1lcy5nZXQoa2V5KTtcbiAgICBpZiAobmFtZSA9PT0gdW5kZWZpbmVkKSB7XG4gICAgICBuYW1lcy5zZXQoa2V5LCAobmFtZSA9IGBtb2R1bGUke25hbWVzLnNpemV9YCkpO1xuICAgICAgaW1wb3J0cyArPSBgaW1wb3J0ICR7d2VzbCA/IG5hbWUgOiBgeyAke2VudHJ5Lm5hbWV9IGFzICR7bmFtZX0gfWB9IGZyb20gJHtKU09OLnN0cmluZ2lmeShzcGVjaWZpZXIpfTtgO1xuICAgIH1cbiAgICBpZiAoZW50cnkuZmxhZyAhPT0gdW5kZWZpbmVkKSB1c2VkLmFkZCgnZ2F0ZWQnKTtcbiAgICBjb25zdCBkZXBlbmRlbmN5ID1cbiAgICAgIGVudHJ5LmZsYWcgPT09IHVuZGVmaW5lZCA/IG5hbWUgOiBgLyogQF9fUFVSRV9fICovIGdhdGVkKCR7SlNPTi5zdHJpbmdpZnkoZW50cnkuZmxhZyl9LCAke25hbWV9KWA7XG4gICAgZGVwZW5kZW5jaWVzLnNldChkZXBlbmRlbmN5LCBkZXBlbmRlbmN5KTtcbiAgfVxuICBjb25zdCB0aXRsZSA9IGAke3Nob3J0fS8ke2ZpbGVcbiAgICAuc3BsaXQoL1tcXFxcL10vKVxuICAgIC5hdCgtMSlcbiAgICAucmVwbGFjZSgvXFwud2VzbCQvLCAnJylcbiAgICAucmVwbGFjZUFsbCgnXycsICctJyl9YDtcbiAgY29uc3QgbGluZXMgPSBnYXRlZFRleHQodGV4dCwgcGFyc2VkLCBzaHJpbmsgfHwgcGFnZSk7XG4gIGNvbnN0IHRlbXBsYXRlID0gKHBhZ2UgPyBsaW5lcy5yZXBsYWNlKC9cXG5cXG4rL2csICdcXG4nKS50cmltU3RhcnQoKSA6IGxpbmVzKVxuICAgIC5yZXBsYWNlKC9bXFxcXGBdfFxcJCg/PVxceykvZywgJ1xcXFwkJicpXG4gICAgLnJlcGxhY2UoL1tBLVphLXpfXVxcdyovZywgKG5hbWUpID0+IChudW1iZXJzLmhhcyhuYW1lKSA/IGBcXCR7JHtudW1iZXJzLmdldChuYW1lKX19dWAgOiBuYW1lKSk7XG4gIC8vIEFsbCBvbiB0aGUgZmlyc3QgbGluZSwgc28gdGhhdCBlYWNoIGxpbmUgb2YgdGhlIHJlc3VsdCBpcyB0aGF0IG9mIHRoZSBmaWxlLlxuICBjb25zdCBjb2RlID0gYGltcG9ydCB7ICR7Wy4uLnVzZWRdLnNvcnQoKS5qb2luKCcsICcpfSB9IGZyb20gXCJAZ2xhbnovd2dzbC9tb2R1bGVcIjske2ltcG9ydHN9ZXhwb3J0IGRlZmF1bHQgLyogQF9fUFVSRV9fICovIHdnc2xNb2R1bGUoJHtKU09OLnN0cmluZ2lmeSh0aXRsZSl9LCBcXGAke3RlbXBsYXRlfVxcYCR7ZGVwZW5kZW5jaWVzLnNpemUgPiAwID8gYCwgWyR7Wy4uLmRlcGVuZGVuY2llcy52YWx1ZXMoKV0uam9pbignLCAnKX1dYCA6ICcnfSk7XFxuYDtcbiAgY29uc3QgY29uc3RhbnRzID0gcmVhZENvbnN0YW50cyh0ZXh0LCBmaWxlKTtcbiAgY29uc3QgbWFwcGluZ3MgPSBgQUFBQSR7JztBQUNBJy5yZXBlYXQodGV4dC5zcGxpdCgnXFxuJykubGVuZ3RoIC0gMSl9YDtcbiAgcmV0dXJuIHtcbiAgICBjb2RlOiBjb25zdGFudHMgPyBjb2RlICsgZXhwb3J0ZWRDb25zdGFudHMoY29uc3RhbnRzKSA6IGNvZGUsXG4gICAgbWFwOiB7IHZlcnNpb246IDMsIHNvdXJjZXM6IFtmaWxlLnNwbGl0KC9bXFxcXC9dLykuYXQoLTEpXSwgc291cmNlc0NvbnRlbnQ6IFt0ZXh0XSwgbmFtZXM6IFtdLCBtYXBwaW5ncyB9LFxuICB9O1xufVxuXG4vKiogRm9yIGVzYnVpbGQgYW5kIHRzdXAuIEBwYXJhbSB7eyBzaHJpbms/OiBib29sZWFuLCBwYWdlPzogYm9vbGVhbiB9fSBvcHRpb25zIEFzIGZvciB7QGxpbmsgY29tcGlsZVdlc2x9LiAqL1xuZXhwb3J0IGNvbnN0IHdlc2xTb3VyY2UgPSAob3B0aW9ucyA9IHt9KSA9PiAoe1xuICBuYW1lOiAnd2VzbCcsXG4gIHNldHVwKGJ1aWxkKSB7XG4gICAgYnVpbGQub25Mb2FkKHsgZmlsdGVyOiAvXFwud2VzbCQvIH0sICh7IHBhdGggfSkgPT4ge1xuICAgICAgY29uc3QgeyBjb2RlLCBtYXAgfSA9IGNvbXBpbGVXZXNsKHJlYWRGaWxlU3luYyhwYXRoLCAndXRmOCcpLCBwYXRoLCBvcHRpb25zKTtcbiAgICAgIHJldHVybiB7XG4gICAgICAgIGNvbnRlbnRzOiBgJHtjb2RlfS8vIyBzb3VyY2VNYXBwaW5nVVJMPWRhdGE6YXBwbGljYXRpb24vanNvbjtiYXNlNjQsJHtCdWZmZXIuZnJvbShKU09OLnN0cmluZ2lmeShtYXApKS50b1N0cmluZygnYmFzZTY0Jyl9YCxcbiAgICAgICAgbG9hZGVyOiAnanMnLFxuICAgICAgICByZXNvbHZlRGlyOiBkaXJuYW1lKHBhdGgpLFxuICAgICAgfTtcbiAgICB9KTtcbiAgfSxcbn0pO1xuXG4vKiogRm9yIFZpdGUsIFZpdGVzdCBhbmQgVml0ZVByZXNzLiBXaGF0IHRoZXkgYnVpbGQgYXJlIHBhZ2VzLiAqL1xuZXhwb3J0IGNvbnN0IHdlc2xNb2R1bGVzID0gKCkgPT4ge1xuICBsZXQgcGFnZSA9IGZhbHNlO1xuICByZXR1cm4ge1xuICAgIG5hbWU6ICd3ZXNsJyxcbiAgICBlbmZvcmNlOiAncHJlJyxcbiAgICBjb25maWdSZXNvbHZlZDogKHsgY29tbWFuZCB9KSA9PiB2b2lkIChwYWdlID0gY29tbWFuZCA9PT0gJ2J1aWxkJyksXG4gICAgdHJhbnNmb3JtOiAodGV4dCwgaWQpID0+IHtcbiAgICAgIGlmICghaWQuZW5kc1dpdGgoJy53ZXNsJykpIHJldHVybiB1bmRlZmluZWQ7XG4gICAgICBjb25zdCB7IGNvZGUsIG1hcCB9ID0gY29tcGlsZVdlc2wodGV4dCwgaWQsIHsgcGFnZSB9KTtcbiAgICAgIHJldHVybiB7IGNvZGUsIG1hcDogcGFnZSA/IG51bGwgOiBtYXAgfTtcbiAgICB9LFxuICB9O1xufTtcbiIsICJjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZGlybmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZVwiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLWNvbnN0YW50cy5tanNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfaW1wb3J0X21ldGFfdXJsID0gXCJmaWxlOi8vL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLWNvbnN0YW50cy5tanNcIjsvLyBDb25zdGFudHMgdGhhdCBzaGFkZXJzIGFuZCBUeXBlU2NyaXB0IHNoYXJlIGFyZSB3cml0dGVuIG9uY2UsIGluIGEgV0VTTCBmaWxlIHRoYXQgaG9sZHMgbm90aGluZyBlbHNlOlxuLy9cbi8vICAgLy8gU2FtcGxlcyB3aG9zZSBtZWFuIGlzIG9uZSBlbnRyeSBvZiB0aGUgc3VtLlxuLy8gICBjb25zdCBGSUxNX0NIVU5LID0gMTZ1O1xuLy8gICBjb25zdCBCQU5EUyA9IGFycmF5PHZlYzJmLCAyPih2ZWMyZigwLjUsIDEuMCksIHZlYzJmKDEuNSwgMi4wKSk7XG4vL1xuLy8gSXRzIG1vZHVsZSBleHBvcnRzIGVhY2ggb2YgdGhlbSBieSBuYW1lOiBhIG51bWJlciBvciBib29sZWFuLCBvciBhbiBhcnJheSBvZiBzdWNoLiBgPGZpbGU+Lndlc2wuZC50c2AgYmVzaWRlIGl0XG4vLyBkZWNsYXJlcyB0aGVtIHRvIFR5cGVTY3JpcHQsIHdpdGggdGhlaXIgY29tbWVudHM6IGBub2RlIHRvb2xzL3BpcGVsaW5lL3dlc2wtY29uc3RhbnRzLm1qc2Agd3JpdGVzIGl0LlxuaW1wb3J0IHsgZXhpc3RzU3luYywgcmVhZEZpbGVTeW5jLCByZWFkZGlyU3luYywgd3JpdGVGaWxlU3luYyB9IGZyb20gJ25vZGU6ZnMnO1xuaW1wb3J0IHsgam9pbiwgcmVsYXRpdmUgfSBmcm9tICdub2RlOnBhdGgnO1xuaW1wb3J0IHsgZmlsZVVSTFRvUGF0aCB9IGZyb20gJ25vZGU6dXJsJztcbmltcG9ydCB7IFdlc2xFcnJvciwgdG9rZW5pemUgfSBmcm9tICcuL3dlc2wtdG9rZW5zLm1qcyc7XG5cbmNvbnN0IFNDQUxBUiA9IC9eKD86aTMyfHUzMnxmMzJ8ZjE2fGJvb2wpJC87XG5jb25zdCBWRUNUT1IgPSAvXnZlYyhbMjM0XSkoW2l1ZmhdPykkLztcbmNvbnN0IE5VTUJFUiA9IC9eKD86MFt4WF1bXFxkYS1mQS1GXStbaXVdP3woPzpcXGQrXFwuP1xcZCp8XFwuXFxkKykoPzpbZUVdWy0rXT9cXGQrKT9baXVmaF0/KSQvO1xuXG4vKiogVGhlIHZhbHVlIG9mIGEgbGl0ZXJhbCBudW1iZXIgYXMgV0dTTCByZWFkcyBpdC4gKi9cbmZ1bmN0aW9uIG51bWJlck9mKHRleHQpIHtcbiAgY29uc3QgaGV4ID0gL14wW3hYXS8udGVzdCh0ZXh0KTtcbiAgcmV0dXJuIE51bWJlcih0ZXh0LnJlcGxhY2UoaGV4ID8gL1tpdV0kLyA6IC9baXVmaF0kLywgJycpKTtcbn1cblxuLyoqXG4gKiBUaGUgY29uc3RhbnRzIG9mIGEgZmlsZSB0aGF0IGRlY2xhcmVzIG5vdGhpbmcgZWxzZSwgb3IgYHVuZGVmaW5lZGAgZm9yIGFueSBvdGhlciBmaWxlLiBBIGZpbGUgbmFtZWQgYGNvbnN0YW50c2AgbXVzdFxuICogYmUgb25lLlxuICpcbiAqIEBwYXJhbSB7c3RyaW5nfSB0ZXh0XG4gKiBAcGFyYW0ge3N0cmluZ30gZmlsZSBGb3IgbWVzc2FnZXMuXG4gKiBAcmV0dXJucyB7eyBuYW1lOiBzdHJpbmcsIHZhbHVlOiBudW1iZXIgfCBib29sZWFuIHwgcmVhZG9ubHkgdW5rbm93bltdLCB0eXBlOiBzdHJpbmcsIGRvYzogc3RyaW5nLCBsaW5lOiBudW1iZXIgfVtdIHxcbiAqICAgdW5kZWZpbmVkfSBgdHlwZWAgaXMgVHlwZVNjcmlwdCdzLCBgZG9jYCB0aGUgbGluZXMgb2YgdGhlIGNvbW1lbnQgcmlnaHQgYmVmb3JlIGl0LlxuICogQHRocm93cyB7V2VzbEVycm9yfVxuICovXG5leHBvcnQgZnVuY3Rpb24gcmVhZENvbnN0YW50cyh0ZXh0LCBmaWxlID0gJ2NvbnN0YW50cy53ZXNsJykge1xuICBjb25zdCBsaW5lT2YgPSAoYXQpID0+IHRleHQuc2xpY2UoMCwgYXQpLnNwbGl0KCdcXG4nKS5sZW5ndGg7XG4gIGNvbnN0IGZhaWwgPSAoYXQsIG1lc3NhZ2UpID0+IHtcbiAgICB0aHJvdyBuZXcgV2VzbEVycm9yKGAke2ZpbGV9OiR7bGluZU9mKGF0KX06ICR7bWVzc2FnZX0uYCk7XG4gIH07XG4gIGNvbnN0IHsgdG9rZW5zLCBjb21tZW50cyB9ID0gdG9rZW5pemUodGV4dCwgZmFpbCk7XG4gIGNvbnN0IGRlbWFuZGVkID0gLyhefFtcXFxcL10pY29uc3RhbnRzXFwud2VzbCQvLnRlc3QoZmlsZSk7XG4gIGlmICghZGVtYW5kZWQgJiYgIWhvbGRzT25seUNvbnN0YW50cyh0b2tlbnMpKSByZXR1cm4gdW5kZWZpbmVkO1xuICBsZXQgbmV4dCA9IDA7XG4gIGNvbnN0IHBlZWsgPSAoKSA9PiB0b2tlbnNbbmV4dF0/LnRleHQ7XG4gIGNvbnN0IGhlcmUgPSAoKSA9PiB0b2tlbnNbbmV4dF0/LmZyb20gPz8gdGV4dC5sZW5ndGg7XG4gIGNvbnN0IHRha2UgPSAoZXhwZWN0ZWQpID0+IHtcbiAgICBjb25zdCB0b2tlbiA9IHRva2Vuc1tuZXh0XTtcbiAgICBpZiAodG9rZW4gPT09IHVuZGVmaW5lZCB8fCAoZXhwZWN0ZWQgIT09IHVuZGVmaW5lZCAmJiB0b2tlbi50ZXh0ICE9PSBleHBlY3RlZCkpXG4gICAgICByZXR1cm4gZmFpbChoZXJlKCksIGBcIiR7dG9rZW4/LnRleHQgPz8gJ3RoZSBlbmQnfVwiIHN0YW5kcyB3aGVyZSBcIiR7ZXhwZWN0ZWQgPz8gJ21vcmUnfVwiIGlzIGV4cGVjdGVkYCk7XG4gICAgbmV4dCsrO1xuICAgIHJldHVybiB0b2tlbjtcbiAgfTtcblxuICAvKiogV2hhdCBhIHR5cGUncyBuYW1lIGFuZCBpdHMgYnJhY2tldHMgc2F5OiBob3cgbWFueSBlbGVtZW50cywgYW5kIHdoYXQgZWFjaCBpcy4gKi9cbiAgY29uc3QgdHlwZSA9ICgpID0+IHtcbiAgICBjb25zdCBhdCA9IGhlcmUoKTtcbiAgICBjb25zdCBuYW1lID0gdGFrZSgpLnRleHQ7XG4gICAgaWYgKFNDQUxBUi50ZXN0KG5hbWUpKSByZXR1cm4geyBraW5kOiAnc2NhbGFyJywgc2NhbGFyOiBuYW1lIH07XG4gICAgY29uc3QgdmVjdG9yID0gVkVDVE9SLmV4ZWMobmFtZSk7XG4gICAgaWYgKHZlY3Rvcikge1xuICAgICAgbGV0IHNjYWxhciA9IHsgaTogJ2kzMicsIHU6ICd1MzInLCBmOiAnZjMyJywgaDogJ2YxNicgfVt2ZWN0b3JbMl1dO1xuICAgICAgaWYgKHNjYWxhciA9PT0gdW5kZWZpbmVkICYmIHBlZWsoKSA9PT0gJzwnKSB7XG4gICAgICAgIHRha2UoJzwnKTtcbiAgICAgICAgY29uc3QgaW5uZXIgPSB0eXBlKCk7XG4gICAgICAgIGlmIChpbm5lci5raW5kICE9PSAnc2NhbGFyJykgZmFpbChhdCwgJ2EgdmVjdG9yIGhvbGRzIG51bWJlcnMnKTtcbiAgICAgICAgc2NhbGFyID0gaW5uZXIuc2NhbGFyO1xuICAgICAgICB0YWtlKCc+Jyk7XG4gICAgICB9XG4gICAgICByZXR1cm4geyBraW5kOiAndmVjdG9yJywgY291bnQ6IE51bWJlcih2ZWN0b3JbMV0pLCBzY2FsYXIgfTtcbiAgICB9XG4gICAgaWYgKG5hbWUgPT09ICdhcnJheScpIHtcbiAgICAgIGlmIChwZWVrKCkgIT09ICc8JykgcmV0dXJuIHsga2luZDogJ2FycmF5JyB9O1xuICAgICAgdGFrZSgnPCcpO1xuICAgICAgY29uc3QgZWxlbWVudCA9IHR5cGUoKTtcbiAgICAgIGxldCBjb3VudDtcbiAgICAgIGlmIChwZWVrKCkgPT09ICcsJykge1xuICAgICAgICB0YWtlKCcsJyk7XG4gICAgICAgIGNvbnN0IGxlbmd0aCA9IHRha2UoKTtcbiAgICAgICAgaWYgKCEvXlxcZCt1PyQvLnRlc3QobGVuZ3RoLnRleHQpKSBmYWlsKGxlbmd0aC5mcm9tLCAndGhlIGxlbmd0aCBvZiBhbiBhcnJheSBpcyBhIGxpdGVyYWwnKTtcbiAgICAgICAgY291bnQgPSBudW1iZXJPZihsZW5ndGgudGV4dCk7XG4gICAgICAgIGlmIChwZWVrKCkgPT09ICcsJykgdGFrZSgnLCcpO1xuICAgICAgfVxuICAgICAgdGFrZSgnPicpO1xuICAgICAgcmV0dXJuIHsga2luZDogJ2FycmF5JywgZWxlbWVudCwgY291bnQgfTtcbiAgICB9XG4gICAgcmV0dXJuIGZhaWwoYXQsIGBcIiR7bmFtZX1cIiBpcyBubyBudW1iZXIsIGJvb2xlYW4sIHZlY3RvciBvciBhcnJheTogYSB0YWJsZSBvZiBjb25zdGFudHMgaG9sZHMgbGl0ZXJhbHNgKTtcbiAgfTtcblxuICBjb25zdCBjaGVjayA9IChhdCwgdmFsdWUsIHdyaXR0ZW4sIHNjYWxhcikgPT4ge1xuICAgIGNvbnN0IHN1ZmZpeCA9IC9eMFt4WF0vLnRlc3Qod3JpdHRlbikgPyAvW2l1XSQvLmV4ZWMod3JpdHRlbik/LlswXSA6IC9baXVmaF0kLy5leGVjKHdyaXR0ZW4pPy5bMF07XG4gICAgY29uc3Qgb3duID0geyBpOiAnaTMyJywgdTogJ3UzMicsIGY6ICdmMzInLCBoOiAnZjE2JyB9W3N1ZmZpeF07XG4gICAgY29uc3QgaXMgPSBvd24gPz8gc2NhbGFyO1xuICAgIGlmIChvd24gIT09IHVuZGVmaW5lZCAmJiBzY2FsYXIgIT09IHVuZGVmaW5lZCAmJiBvd24gIT09IHNjYWxhcikgZmFpbChhdCwgYCR7d3JpdHRlbn0gaXMgbm8gJHtzY2FsYXJ9YCk7XG4gICAgaWYgKChpcyA9PT0gJ2kzMicgfHwgaXMgPT09ICd1MzInKSAmJiAhTnVtYmVyLmlzSW50ZWdlcih2YWx1ZSkpIGZhaWwoYXQsIGAke3dyaXR0ZW59IGlzIG5vICR7aXN9YCk7XG4gICAgaWYgKGlzID09PSAnYm9vbCcpIGZhaWwoYXQsIGAke3dyaXR0ZW59IGlzIG5vIGJvb2xgKTtcbiAgICBjb25zdCBbbG93LCBoaWdoXSA9XG4gICAgICBpcyA9PT0gJ3UzMicgPyBbMCwgMiAqKiAzMiAtIDFdIDogaXMgPT09ICdpMzInID8gWy0oMiAqKiAzMSksIDIgKiogMzEgLSAxXSA6IFstMy40MDI4MjM1ZTM4LCAzLjQwMjgyMzVlMzhdO1xuICAgIGlmICh2YWx1ZSA8IGxvdyB8fCB2YWx1ZSA+IGhpZ2gpIGZhaWwoYXQsIGAke3dyaXR0ZW59IGlzIG91dCBvZiByYW5nZWApO1xuICB9O1xuXG4gIC8qKiBAcmV0dXJucyB7eyB2YWx1ZTogdW5rbm93biwgdHlwZTogc3RyaW5nIH19ICovXG4gIGNvbnN0IGV4cHJlc3Npb24gPSAod2FudGVkKSA9PiB7XG4gICAgY29uc3QgYXQgPSBoZXJlKCk7XG4gICAgY29uc3QgdG9rZW4gPSBwZWVrKCk7XG4gICAgaWYgKHRva2VuID09PSAndHJ1ZScgfHwgdG9rZW4gPT09ICdmYWxzZScpIHtcbiAgICAgIGlmICh3YW50ZWQgIT09IHVuZGVmaW5lZCAmJiB3YW50ZWQuc2NhbGFyICE9PSAnYm9vbCcpIGZhaWwoYXQsIGAke3Rva2VufSBzdGFuZHMgd2hlcmUgYSBudW1iZXIgaXMgZXhwZWN0ZWRgKTtcbiAgICAgIHRha2UoKTtcbiAgICAgIHJldHVybiB7IHZhbHVlOiB0b2tlbiA9PT0gJ3RydWUnLCB0eXBlOiAnYm9vbGVhbicgfTtcbiAgICB9XG4gICAgaWYgKHRva2VuID09PSAnLScgfHwgTlVNQkVSLnRlc3QodG9rZW4gPz8gJycpKSB7XG4gICAgICBpZiAod2FudGVkICE9PSB1bmRlZmluZWQgJiYgd2FudGVkLmtpbmQgIT09ICdzY2FsYXInKSBmYWlsKGF0LCAnYSBudW1iZXIgc3RhbmRzIHdoZXJlIHNldmVyYWwgYXJlIGV4cGVjdGVkJyk7XG4gICAgICBpZiAodG9rZW4gPT09ICctJykgdGFrZSgpO1xuICAgICAgY29uc3QgeyB0ZXh0OiB3cml0dGVuLCBmcm9tIH0gPSB0YWtlKCk7XG4gICAgICBpZiAoIU5VTUJFUi50ZXN0KHdyaXR0ZW4pKSBmYWlsKGZyb20sIGBcIiR7d3JpdHRlbn1cIiBpcyBubyBsaXRlcmFsYCk7XG4gICAgICBjb25zdCB2YWx1ZSA9IHRva2VuID09PSAnLScgPyAtbnVtYmVyT2Yod3JpdHRlbikgOiBudW1iZXJPZih3cml0dGVuKTtcbiAgICAgIGNoZWNrKGZyb20sIHZhbHVlLCB3cml0dGVuLCB3YW50ZWQ/LnNjYWxhcik7XG4gICAgICByZXR1cm4geyB2YWx1ZSwgdHlwZTogJ251bWJlcicgfTtcbiAgICB9XG4gICAgY29uc3QgZm91bmQgPSB0eXBlKCk7XG4gICAgaWYgKGZvdW5kLmtpbmQgPT09ICdzY2FsYXInKSBmYWlsKGF0LCAnYSB0YWJsZSBvZiBjb25zdGFudHMgY29udmVydHMgbm8gdmFsdWVzOiB3cml0ZSB0aGUgbGl0ZXJhbCcpO1xuICAgIGlmICh3YW50ZWQgIT09IHVuZGVmaW5lZCAmJiB3YW50ZWQua2luZCAhPT0gZm91bmQua2luZCkgZmFpbChhdCwgJ3RoZSB2YWx1ZSBpcyBvZiBhbm90aGVyIHR5cGUnKTtcbiAgICB0YWtlKCcoJyk7XG4gICAgY29uc3Qgb2YgPSBmb3VuZC5raW5kID09PSAndmVjdG9yJyA/IHsga2luZDogJ3NjYWxhcicsIHNjYWxhcjogZm91bmQuc2NhbGFyIH0gOiBmb3VuZC5lbGVtZW50O1xuICAgIGNvbnN0IGVsZW1lbnRzID0gW107XG4gICAgd2hpbGUgKHBlZWsoKSAhPT0gJyknKSB7XG4gICAgICBlbGVtZW50cy5wdXNoKGV4cHJlc3Npb24ob2YpKTtcbiAgICAgIGlmIChwZWVrKCkgIT09ICcpJykgdGFrZSgnLCcpO1xuICAgIH1cbiAgICB0YWtlKCcpJyk7XG4gICAgY29uc3QgY291bnQgPSBmb3VuZC5jb3VudCA/PyAod2FudGVkPy5raW5kID09PSAnYXJyYXknID8gd2FudGVkLmNvdW50IDogdW5kZWZpbmVkKSA/PyBlbGVtZW50cy5sZW5ndGg7XG4gICAgaWYgKGVsZW1lbnRzLmxlbmd0aCA9PT0gMCB8fCBlbGVtZW50cy5sZW5ndGggIT09IGNvdW50KVxuICAgICAgZmFpbChhdCwgYCR7ZWxlbWVudHMubGVuZ3RofSB2YWx1ZXMgc3RhbmQgd2hlcmUgJHtjb3VudCB8fCAnc29tZSd9IGFyZSBleHBlY3RlZGApO1xuICAgIGNvbnN0IGVsZW1lbnQgPSBlbGVtZW50c1swXS50eXBlO1xuICAgIGlmIChlbGVtZW50cy5zb21lKCh7IHR5cGU6IG90aGVyIH0pID0+IG90aGVyICE9PSBlbGVtZW50KSkgZmFpbChhdCwgJ3RoZSBlbGVtZW50cyBhcmUgb2Ygc2V2ZXJhbCB0eXBlcycpO1xuICAgIHJldHVybiB7XG4gICAgICB2YWx1ZTogZWxlbWVudHMubWFwKCh7IHZhbHVlIH0pID0+IHZhbHVlKSxcbiAgICAgIHR5cGU6XG4gICAgICAgIGZvdW5kLmtpbmQgPT09ICd2ZWN0b3InXG4gICAgICAgICAgPyBgcmVhZG9ubHkgWyR7ZWxlbWVudHMubWFwKCgpID0+IGVsZW1lbnQpLmpvaW4oJywgJyl9XWBcbiAgICAgICAgICA6IGByZWFkb25seSAkey9eXFx3KyQvLnRlc3QoZWxlbWVudCkgPyBlbGVtZW50IDogYCgke2VsZW1lbnR9KWB9W11gLFxuICAgIH07XG4gIH07XG5cbiAgY29uc3QgY29uc3RhbnRzID0gW107XG4gIHdoaWxlIChuZXh0IDwgdG9rZW5zLmxlbmd0aCkge1xuICAgIGNvbnN0IGF0ID0gaGVyZSgpO1xuICAgIGlmIChwZWVrKCkgIT09ICdjb25zdCcpXG4gICAgICBmYWlsKGF0LCBgXCIke3BlZWsoKX1cIiBzdGFuZHMgaW4gYSB0YWJsZSBvZiBjb25zdGFudHMsIHdoaWNoIGhvbGRzIFwiY29uc3QgTkFNRSA9IGxpdGVyYWw7XCIgYWxvbmVgKTtcbiAgICB0YWtlKCk7XG4gICAgY29uc3QgbmFtZSA9IHRha2UoKTtcbiAgICBpZiAoY29uc3RhbnRzLnNvbWUoKG90aGVyKSA9PiBvdGhlci5uYW1lID09PSBuYW1lLnRleHQpKSBmYWlsKG5hbWUuZnJvbSwgYCR7bmFtZS50ZXh0fSBpcyBkZWNsYXJlZCB0d2ljZWApO1xuICAgIGxldCBkZWNsYXJlZDtcbiAgICBpZiAocGVlaygpID09PSAnOicpIHtcbiAgICAgIHRha2UoKTtcbiAgICAgIGRlY2xhcmVkID0gdHlwZSgpO1xuICAgIH1cbiAgICB0YWtlKCc9Jyk7XG4gICAgY29uc3QgZm91bmQgPSBleHByZXNzaW9uKGRlY2xhcmVkKTtcbiAgICBpZiAocGVlaygpICE9PSAnOycpIGZhaWwoaGVyZSgpLCBgXCIke3BlZWsoKSA/PyAndGhlIGVuZCd9XCIgZm9sbG93cyB0aGUgbGl0ZXJhbDogd3JpdGUgdGhlIHZhbHVlIGl0c2VsZmApO1xuICAgIHRha2UoJzsnKTtcbiAgICBjb25zdGFudHMucHVzaCh7IG5hbWU6IG5hbWUudGV4dCwgLi4uZm91bmQsIGRvYzogY29tbWVudEJlZm9yZSh0ZXh0LCBjb21tZW50cywgYXQpLCBsaW5lOiBsaW5lT2YoYXQpIH0pO1xuICB9XG4gIGlmIChjb25zdGFudHMubGVuZ3RoID09PSAwKSBmYWlsKDAsICdpdCBob2xkcyBubyBjb25zdGFudCcpO1xuICByZXR1cm4gY29uc3RhbnRzO1xufVxuXG4vKiogV2hldGhlciBhbGwgZGVjbGFyYXRpb25zIGFyZSBgY29uc3RgLCB3aXRob3V0IGltcG9ydHMsIGdhdGVzIG9yIGF0dHJpYnV0ZXMuICovXG5mdW5jdGlvbiBob2xkc09ubHlDb25zdGFudHModG9rZW5zKSB7XG4gIGlmICh0b2tlbnMubGVuZ3RoID09PSAwKSByZXR1cm4gZmFsc2U7XG4gIGxldCBiZWdpbnMgPSB0cnVlO1xuICBmb3IgKGNvbnN0IHsgdGV4dCB9IG9mIHRva2Vucykge1xuICAgIGlmIChiZWdpbnMgJiYgdGV4dCAhPT0gJ2NvbnN0JykgcmV0dXJuIGZhbHNlO1xuICAgIGJlZ2lucyA9IHRleHQgPT09ICc7JztcbiAgfVxuICByZXR1cm4gdHJ1ZTtcbn1cblxuLyoqIFRoZSBsaW5lcyBvZiBgLy9gIGRpcmVjdGx5IGFib3ZlIGEgcGxhY2UsIHdpdGhvdXQgdGhlaXIgc2xhc2hlcy4gKi9cbmZ1bmN0aW9uIGNvbW1lbnRCZWZvcmUodGV4dCwgY29tbWVudHMsIGF0KSB7XG4gIGNvbnN0IGxpbmVzID0gW107XG4gIGxldCBiZWxvdyA9IHRleHQubGFzdEluZGV4T2YoJ1xcbicsIGF0IC0gMSkgKyAxO1xuICBmb3IgKGNvbnN0IHsgZnJvbSwgdG8gfSBvZiBbLi4uY29tbWVudHNdLnJldmVyc2UoKSkge1xuICAgIGlmIChmcm9tID49IGF0KSBjb250aW51ZTtcbiAgICBjb25zdCBiZWdpbiA9IHRleHQubGFzdEluZGV4T2YoJ1xcbicsIGZyb20gLSAxKSArIDE7XG4gICAgaWYgKHRvICsgMSAhPT0gYmVsb3cgfHwgdGV4dC5zbGljZShiZWdpbiwgZnJvbSkudHJpbSgpICE9PSAnJyB8fCAhdGV4dC5zdGFydHNXaXRoKCcvLycsIGZyb20pKSBicmVhaztcbiAgICBsaW5lcy51bnNoaWZ0KHRleHQuc2xpY2UoZnJvbSArIDIsIHRvKS50cmltKCkpO1xuICAgIGJlbG93ID0gYmVnaW47XG4gIH1cbiAgcmV0dXJuIGxpbmVzLmpvaW4oJ1xcbicpO1xufVxuXG4vKiogVGhlIGV4cG9ydHMgb2YgYSBtb2R1bGUgd2l0aCB0aGVzZSBjb25zdGFudHMuICovXG5leHBvcnQgY29uc3QgZXhwb3J0ZWRDb25zdGFudHMgPSAoY29uc3RhbnRzKSA9PlxuICBgZXhwb3J0IGNvbnN0ICR7Y29uc3RhbnRzLm1hcCgoeyBuYW1lLCB2YWx1ZSB9KSA9PiBgJHtuYW1lfSA9ICR7SlNPTi5zdHJpbmdpZnkodmFsdWUpfWApLmpvaW4oJywgJyl9O1xcbmA7XG5cbi8qKlxuICogV2hhdCBkZWNsYXJlcyBhIHRhYmxlIG9mIGNvbnN0YW50cyB0byBUeXBlU2NyaXB0LlxuICogQHRocm93cyB7V2VzbEVycm9yfVxuICovXG5leHBvcnQgZnVuY3Rpb24gZGVjbGFyZUNvbnN0YW50cyh0ZXh0LCBmaWxlKSB7XG4gIGNvbnN0IGxpbmVzID0gW1wiaW1wb3J0IHR5cGUgeyBXZ3NsTW9kdWxlIH0gZnJvbSAnQGdsYW56L3dnc2wnO1wiLCAnJ107XG4gIGZvciAoY29uc3QgeyBuYW1lLCB0eXBlLCBkb2MgfSBvZiByZWFkQ29uc3RhbnRzKHRleHQsIGZpbGUpKSB7XG4gICAgY29uc3QgZG9jcyA9IGRvYy5zcGxpdCgnXFxuJyk7XG4gICAgaWYgKGRvYyAhPT0gJycgJiYgZG9jcy5sZW5ndGggPT09IDEpIGxpbmVzLnB1c2goYC8qKiAke2RvY30gKi9gKTtcbiAgICBlbHNlIGlmIChkb2MgIT09ICcnKSBsaW5lcy5wdXNoKCcvKionLCAuLi5kb2NzLm1hcCgobGluZSkgPT4gYCAqICR7bGluZX1gLnRyaW1FbmQoKSksICcgKi8nKTtcbiAgICBsaW5lcy5wdXNoKGBleHBvcnQgY29uc3QgJHtuYW1lfTogJHt0eXBlfTtgKTtcbiAgfVxuICByZXR1cm4gYCR7bGluZXMuam9pbignXFxuJyl9XFxuXFxuZGVjbGFyZSBjb25zdCBtb2R1bGU6IFdnc2xNb2R1bGU7XFxuZXhwb3J0IGRlZmF1bHQgbW9kdWxlO1xcbmA7XG59XG5cbi8qKiBUaGUgZmlsZSB0aGF0IGRlY2xhcmVzIGEgdGFibGUgdG8gVHlwZVNjcmlwdC4gKi9cbmV4cG9ydCBjb25zdCBkZWNsYXJhdGlvbkZpbGUgPSAoZmlsZSkgPT4gYCR7ZmlsZX0uZC50c2A7XG5cbi8qKiBBbGwgdGFibGVzIG9mIGNvbnN0YW50cyBiZWxvdyB0aGUgc291cmNlcyBvZiB0aGUgcGFja2FnZXMuIEByZXR1cm5zIHtzdHJpbmdbXX0gKi9cbmV4cG9ydCBmdW5jdGlvbiBjb25zdGFudEZpbGVzKHJvb3QpIHtcbiAgcmV0dXJuIHJlYWRkaXJTeW5jKGpvaW4ocm9vdCwgJ3BhY2thZ2VzJykpXG4gICAgLm1hcCgobmFtZSkgPT4gam9pbihyb290LCAncGFja2FnZXMnLCBuYW1lLCAnc3JjJykpXG4gICAgLmZpbHRlcigoZm9sZGVyKSA9PiBleGlzdHNTeW5jKGZvbGRlcikpXG4gICAgLmZsYXRNYXAoKGZvbGRlcikgPT4gcmVhZGRpclN5bmMoZm9sZGVyLCB7IHJlY3Vyc2l2ZTogdHJ1ZSwgZW5jb2Rpbmc6ICd1dGY4JyB9KS5tYXAoKHBhdGgpID0+IGpvaW4oZm9sZGVyLCBwYXRoKSkpXG4gICAgLmZpbHRlcigoZmlsZSkgPT4gZmlsZS5lbmRzV2l0aCgnLndlc2wnKSAmJiByZWFkQ29uc3RhbnRzKHJlYWRGaWxlU3luYyhmaWxlLCAndXRmOCcpLCBmaWxlKSAhPT0gdW5kZWZpbmVkKVxuICAgIC5zb3J0KCk7XG59XG5cbmlmIChwcm9jZXNzLmFyZ3ZbMV0gPT09IGZpbGVVUkxUb1BhdGgoaW1wb3J0Lm1ldGEudXJsKSkge1xuICBjb25zdCByb290ID0gam9pbihpbXBvcnQubWV0YS5kaXJuYW1lLCAnLi4vLi4nKTtcbiAgZm9yIChjb25zdCBmaWxlIG9mIGNvbnN0YW50RmlsZXMocm9vdCkpIHtcbiAgICB3cml0ZUZpbGVTeW5jKGRlY2xhcmF0aW9uRmlsZShmaWxlKSwgZGVjbGFyZUNvbnN0YW50cyhyZWFkRmlsZVN5bmMoZmlsZSwgJ3V0ZjgnKSwgZmlsZSkpO1xuICAgIHByb2Nlc3Muc3Rkb3V0LndyaXRlKGAke3JlbGF0aXZlKHJvb3QsIGRlY2xhcmF0aW9uRmlsZShmaWxlKSl9XFxuYCk7XG4gIH1cbn1cbiIsICJjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZGlybmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZVwiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLXRva2Vucy5tanNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfaW1wb3J0X21ldGFfdXJsID0gXCJmaWxlOi8vL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLXRva2Vucy5tanNcIjsvLyBUaGUgdG9rZW5zIG9mIGEgV0VTTCBmaWxlLlxuXG4vKiogQSBgLndlc2xgIGZpbGUgdGhhdCBjYW5ub3QgYmUgdHVybmVkIGludG8gYSBtb2R1bGU6IHdoYXQgaXMgd3JvbmcsIHdpdGggZmlsZSBhbmQgbGluZS4gKi9cbmV4cG9ydCBjbGFzcyBXZXNsRXJyb3IgZXh0ZW5kcyBFcnJvciB7XG4gIG5hbWUgPSAnV2VzbEVycm9yJztcbn1cblxuY29uc3QgVE9LRU4gPSAvXFwvXFwvW15cXG5dKnxcXC9cXCp8W0EtWmEtel9dXFx3KnwoPzpcXGR8XFwuXFxkKSg/OltlRXBQXVstK118W1xcdy5dKSp8Ojp8JiZ8XFx8XFx8fFxcUy9nO1xuXG4vKipcbiAqIFRva2VucyB3aXRoIHRoZWlyIHBsYWNlcy4gQ29tbWVudHMgYXJlIGxpc3RlZCBhcGFydC5cbiAqXG4gKiBAcGFyYW0ge3N0cmluZ30gdGV4dFxuICogQHBhcmFtIHsoYXQ6IG51bWJlciwgbWVzc2FnZTogc3RyaW5nKSA9PiBuZXZlcn0gZmFpbFxuICovXG5leHBvcnQgZnVuY3Rpb24gdG9rZW5pemUodGV4dCwgZmFpbCkge1xuICBjb25zdCB0b2tlbnMgPSBbXTtcbiAgY29uc3QgY29tbWVudHMgPSBbXTtcbiAgVE9LRU4ubGFzdEluZGV4ID0gMDtcbiAgZm9yIChsZXQgbWF0Y2g7IChtYXRjaCA9IFRPS0VOLmV4ZWModGV4dCkpOykge1xuICAgIGNvbnN0IGZyb20gPSBtYXRjaC5pbmRleDtcbiAgICBpZiAobWF0Y2hbMF0gPT09ICcvKicpIHtcbiAgICAgIC8vIFRoZXkgbmVzdC5cbiAgICAgIGxldCBkZXB0aCA9IDA7XG4gICAgICBjb25zdCBlZGdlID0gL1xcL1xcKnxcXCpcXC8vZztcbiAgICAgIGVkZ2UubGFzdEluZGV4ID0gZnJvbTtcbiAgICAgIGZvciAobGV0IGZvdW5kOyAoZm91bmQgPSBlZGdlLmV4ZWModGV4dCkpOykge1xuICAgICAgICBkZXB0aCArPSBmb3VuZFswXSA9PT0gJy8qJyA/IDEgOiAtMTtcbiAgICAgICAgaWYgKGRlcHRoID09PSAwKSBicmVhaztcbiAgICAgIH1cbiAgICAgIGlmIChkZXB0aCAhPT0gMCkgZmFpbChmcm9tLCAnYSBibG9jayBjb21tZW50IG5ldmVyIGVuZHMnKTtcbiAgICAgIGNvbW1lbnRzLnB1c2goeyBmcm9tLCB0bzogZWRnZS5sYXN0SW5kZXggfSk7XG4gICAgICBUT0tFTi5sYXN0SW5kZXggPSBlZGdlLmxhc3RJbmRleDtcbiAgICB9IGVsc2UgaWYgKG1hdGNoWzBdLnN0YXJ0c1dpdGgoJy8vJykpIGNvbW1lbnRzLnB1c2goeyBmcm9tLCB0bzogVE9LRU4ubGFzdEluZGV4IH0pO1xuICAgIGVsc2UgdG9rZW5zLnB1c2goeyB0ZXh0OiBtYXRjaFswXSwgZnJvbSwgdG86IFRPS0VOLmxhc3RJbmRleCB9KTtcbiAgfVxuICByZXR1cm4geyB0b2tlbnMsIGNvbW1lbnRzIH07XG59XG4iLCAiY29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2Rpcm5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmVcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZmlsZW5hbWUgPSBcIi90bXAvd3QtbWUvdG9vbHMvcGlwZWxpbmUvd2VzbC1uYW1lcy5tanNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfaW1wb3J0X21ldGFfdXJsID0gXCJmaWxlOi8vL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLW5hbWVzLm1qc1wiOy8vIFNob3J0IG5hbWVzIGZvciB3aGF0IGlzIGxvY2FsIHRvIHRoZSBmdW5jdGlvbnMgb2YgYSBzaGFkZXIsIGZvciB3aGF0IGlzIHB1Ymxpc2hlZDogcGFyYW1ldGVycywgdmFyaWFibGVzIGFuZFxuLy8gY29uc3RhbnRzIGluc2lkZSBvZiBmdW5jdGlvbnMuIE5hbWVzIHRoYXQgb3RoZXIgbW9kdWxlcywgaG9zdHMgb3IgdXNlcnMnIG93biBXR1NMIG1heSB1c2Ugc3RheTogdGhvc2Ugb2YgZnVuY3Rpb25zLFxuLy8gc3RydWN0cywgbWVtYmVycywgY29uc3RhbnRzIG9mIGEgbW9kdWxlLlxuXG4vKiogTmFtZXMgdGhhdCBhcmUgbmV2ZXIgZ2l2ZW46IHRoZSBrZXl3b3JkcyBvZiBXR1NMIHdpdGggYXQgbW9zdCB0d28gbGV0dGVycywgYW5kIGBfYC4gKi9cbmNvbnN0IEtFWVdPUkRTID0gbmV3IFNldChbJ18nLCAnZG8nLCAnZm4nLCAnaWYnLCAnYXMnLCAnaXMnLCAnb2YnXSk7XG5cbi8qKiBhLCBiLCBcdTIwMjYgeiwgQSwgXHUyMDI2IFosIGFhLCBhYiwgXHUyMDI2ICovXG5mdW5jdGlvbiogc2hvcnROYW1lcygpIHtcbiAgY29uc3QgbGV0dGVycyA9ICdhYmNkZWZnaGlqa2xtbm9wcXJzdHV2d3h5ekFCQ0RFRkdISUpLTE1OT1BRUlNUVVZXWFlaJztcbiAgZm9yIChjb25zdCBsZXR0ZXIgb2YgbGV0dGVycykgeWllbGQgbGV0dGVyO1xuICBmb3IgKGNvbnN0IGZpcnN0IG9mIGxldHRlcnMpIGZvciAoY29uc3Qgc2Vjb25kIG9mIGxldHRlcnMpIHlpZWxkIGZpcnN0ICsgc2Vjb25kO1xufVxuXG4vKipcbiAqIEBwYXJhbSB7eyB0ZXh0OiBzdHJpbmcsIGZyb206IG51bWJlciwgdG86IG51bWJlciB9W119IHRva2VucyBPZiBhIFdFU0wgZmlsZSwgd2l0aG91dCBjb21tZW50cy5cbiAqIEByZXR1cm5zIHt7IGZyb206IG51bWJlciwgdG86IG51bWJlciwgdGV4dDogc3RyaW5nIH1bXX0gUmVwbGFjZW1lbnRzIG9mIG5hbWVzLCBlYWNoIGxpbmUgaW4gaXRzIHBsYWNlLlxuICovXG5leHBvcnQgZnVuY3Rpb24gc2hvcnRlbkxvY2Fscyh0b2tlbnMpIHtcbiAgY29uc3QgZWRpdHMgPSBbXTtcbiAgY29uc3QgaWRlbnRpZmllcnMgPSBuZXcgU2V0KHRva2Vucy5tYXAoKHsgdGV4dCB9KSA9PiB0ZXh0KSk7XG4gIGNvbnN0IHRleHQgPSAoaSkgPT4gdG9rZW5zW2ldPy50ZXh0O1xuICBsZXQgaSA9IDA7XG5cbiAgLyoqIFRoZSBwbGFjZSBhZnRlciB0aGUgYnJhY2tldCB0aGF0IG9wZW5zIGF0IGBhdGAuICovXG4gIGNvbnN0IGFmdGVyQnJhY2tldCA9IChhdCkgPT4ge1xuICAgIGxldCBkZXB0aCA9IDA7XG4gICAgZG8ge1xuICAgICAgaWYgKCcoW3snLmluY2x1ZGVzKHRleHQoYXQpKSkgZGVwdGgrKztcbiAgICAgIGlmICgnKV19Jy5pbmNsdWRlcyh0ZXh0KGF0KSkpIGRlcHRoLS07XG4gICAgICBhdCsrO1xuICAgIH0gd2hpbGUgKGRlcHRoID4gMCAmJiBhdCA8IHRva2Vucy5sZW5ndGgpO1xuICAgIHJldHVybiBhdDtcbiAgfTtcblxuICBjb25zdCBmdW5jdGlvbkF0ID0gKCkgPT4ge1xuICAgIGNvbnN0IG5hbWVzID0gbmV3IE1hcCgpO1xuICAgIGNvbnN0IGNhbmRpZGF0ZXMgPSBzaG9ydE5hbWVzKCk7XG4gICAgY29uc3Qgc2hvcnRGb3IgPSAobmFtZSkgPT4ge1xuICAgICAgbGV0IHNob3J0ID0gbmFtZXMuZ2V0KG5hbWUpO1xuICAgICAgd2hpbGUgKHNob3J0ID09PSB1bmRlZmluZWQpIHtcbiAgICAgICAgY29uc3QgeyB2YWx1ZSB9ID0gY2FuZGlkYXRlcy5uZXh0KCk7XG4gICAgICAgIGlmICh2YWx1ZSA9PT0gdW5kZWZpbmVkKSBzaG9ydCA9IG5hbWU7XG4gICAgICAgIGVsc2UgaWYgKCFpZGVudGlmaWVycy5oYXModmFsdWUpICYmICFLRVlXT1JEUy5oYXModmFsdWUpKSBzaG9ydCA9IHZhbHVlO1xuICAgICAgfVxuICAgICAgbmFtZXMuc2V0KG5hbWUsIHNob3J0KTtcbiAgICAgIHJldHVybiBzaG9ydDtcbiAgICB9O1xuICAgIC8vIE5hbWVzIGJ5IHRoZSBibG9jayB0aGF0IGRlY2xhcmVzIHRoZW0sIHRoZSBpbm5lcm1vc3QgbGFzdC5cbiAgICBjb25zdCBzY29wZXMgPSBbbmV3IFNldCgpXTtcbiAgICBjb25zdCBkZWNsYXJlID0gKG5hbWUpID0+IHNjb3Blcy5hdCgtMSkuYWRkKG5hbWUpO1xuICAgIGNvbnN0IHJlcGxhY2UgPSAoYXQpID0+IHtcbiAgICAgIGNvbnN0IHsgdGV4dDogbmFtZSwgZnJvbSwgdG8gfSA9IHRva2Vuc1thdF07XG4gICAgICBjb25zdCBzaG9ydCA9IHNob3J0Rm9yKG5hbWUpO1xuICAgICAgaWYgKHNob3J0Lmxlbmd0aCA8IG5hbWUubGVuZ3RoKSBlZGl0cy5wdXNoKHsgZnJvbSwgdG8sIHRleHQ6IHNob3J0IH0pO1xuICAgIH07XG4gICAgLyoqIEFuIGF0dHJpYnV0ZSB3aXRoIGl0cyBhcmd1bWVudHMsIHdoaWNoIGFyZSBubyBuYW1lcyBvZiBvdXJzLiAqL1xuICAgIGNvbnN0IHNraXBBdHRyaWJ1dGUgPSAoKSA9PiB7XG4gICAgICBpICs9IDI7XG4gICAgICBpZiAodGV4dChpKSA9PT0gJygnKSBpID0gYWZ0ZXJCcmFja2V0KGkpO1xuICAgIH07XG5cbiAgICBpICs9IDI7XG4gICAgLy8gUGFyYW1ldGVyczogYSBuYW1lIGJlZm9yZSBhIGNvbG9uLCBvdXRzaWRlIG9mIHR5cGVzLlxuICAgIGZvciAobGV0IGRlcHRoID0gMDsgOykge1xuICAgICAgY29uc3QgdG9rZW4gPSB0ZXh0KGkpO1xuICAgICAgaWYgKHRva2VuID09PSAnQCcpIHtcbiAgICAgICAgc2tpcEF0dHJpYnV0ZSgpO1xuICAgICAgICBjb250aW51ZTtcbiAgICAgIH1cbiAgICAgIGlmICh0b2tlbiA9PT0gJygnIHx8IHRva2VuID09PSAnPCcpIGRlcHRoKys7XG4gICAgICBpZiAodG9rZW4gPT09ICcpJyB8fCB0b2tlbiA9PT0gJz4nKSBkZXB0aC0tO1xuICAgICAgaWYgKGRlcHRoID09PSAxICYmIHRleHQoaSArIDEpID09PSAnOicgJiYgL15bQS1aYS16X10vLnRlc3QodG9rZW4pKSB7XG4gICAgICAgIGRlY2xhcmUodG9rZW4pO1xuICAgICAgICByZXBsYWNlKGkpO1xuICAgICAgfVxuICAgICAgaSsrO1xuICAgICAgaWYgKGRlcHRoID09PSAwKSBicmVhaztcbiAgICB9XG4gICAgd2hpbGUgKHRleHQoaSkgIT09ICd7JykgaSArPSAxO1xuXG4gICAgLy8gV2hhdCBhIHN0YXRlbWVudCBkZWNsYXJlcyBpcyBrbm93biBhZnRlciBpdDogYGxldCB4ID0gZih4KTtgIHJlYWRzIGFub3RoZXIgeC5cbiAgICBsZXQgcGVuZGluZyA9IFtdO1xuICAgIC8vIERlcHRocyBvZiBicmFja2V0cyBhdCB3aGljaCB0aGUgaGVhZHMgb2YgbG9vcHMgYmVnYW46IHRoZWlyIHZhcmlhYmxlcyBsaXZlIGFzIGxvbmcgYXMgdGhlIGJsb2NrIGFmdGVyIGl0LlxuICAgIGNvbnN0IGhlYWRzID0gW107XG4gICAgbGV0IHJvdW5kID0gMDtcbiAgICBjb25zdCBzZXR0bGUgPSAoKSA9PiB7XG4gICAgICBwZW5kaW5nLmZvckVhY2goZGVjbGFyZSk7XG4gICAgICBwZW5kaW5nID0gW107XG4gICAgfTtcbiAgICBsZXQgZGVwdGggPSAwO1xuICAgIGRvIHtcbiAgICAgIGNvbnN0IHRva2VuID0gdGV4dChpKTtcbiAgICAgIGlmICh0b2tlbiA9PT0gJ0AnKSB7XG4gICAgICAgIHNraXBBdHRyaWJ1dGUoKTtcbiAgICAgICAgY29udGludWU7XG4gICAgICB9XG4gICAgICBpZiAodG9rZW4gPT09ICdmb3InKSB7XG4gICAgICAgIHNjb3Blcy5wdXNoKG5ldyBTZXQoKSk7XG4gICAgICAgIGhlYWRzLnB1c2goeyBkZXB0aCwgcm91bmQgfSk7XG4gICAgICB9IGVsc2UgaWYgKHRva2VuID09PSAnKCcpIHJvdW5kKys7XG4gICAgICBlbHNlIGlmICh0b2tlbiA9PT0gJyknKSByb3VuZC0tO1xuICAgICAgZWxzZSBpZiAodG9rZW4gPT09ICc7Jykgc2V0dGxlKCk7XG4gICAgICBlbHNlIGlmICh0b2tlbiA9PT0gJ3snKSB7XG4gICAgICAgIHNldHRsZSgpO1xuICAgICAgICBkZXB0aCsrO1xuICAgICAgICBzY29wZXMucHVzaChuZXcgU2V0KCkpO1xuICAgICAgfSBlbHNlIGlmICh0b2tlbiA9PT0gJ30nKSB7XG4gICAgICAgIHNldHRsZSgpO1xuICAgICAgICBkZXB0aC0tO1xuICAgICAgICBzY29wZXMucG9wKCk7XG4gICAgICAgIGlmIChoZWFkcy5hdCgtMSk/LmRlcHRoID09PSBkZXB0aCAmJiBoZWFkcy5hdCgtMSkucm91bmQgPT09IHJvdW5kKSB7XG4gICAgICAgICAgaGVhZHMucG9wKCk7XG4gICAgICAgICAgc2NvcGVzLnBvcCgpO1xuICAgICAgICB9XG4gICAgICB9IGVsc2UgaWYgKC9eKGxldHx2YXJ8Y29uc3QpJC8udGVzdCh0b2tlbikpIHtcbiAgICAgICAgbGV0IGF0ID0gaSArIDE7XG4gICAgICAgIGlmICh0ZXh0KGF0KSA9PT0gJzwnKSB3aGlsZSAodGV4dChhdCsrKSAhPT0gJz4nKTtcbiAgICAgICAgcGVuZGluZy5wdXNoKHRleHQoYXQpKTtcbiAgICAgICAgLy8gVXAgdG8gdGhlIG5hbWU7IGl0IGlzIHJlcGxhY2VkIGhlcmUsIHNpbmNlIGl0IGlzIG5vdCBrbm93biB5ZXQuXG4gICAgICAgIHJlcGxhY2UoYXQpO1xuICAgICAgICBpID0gYXQ7XG4gICAgICB9IGVsc2UgaWYgKC9eW0EtWmEtel9dLy50ZXN0KHRva2VuKSAmJiB0ZXh0KGkgLSAxKSAhPT0gJy4nICYmIHNjb3Blcy5zb21lKChzY29wZSkgPT4gc2NvcGUuaGFzKHRva2VuKSkpXG4gICAgICAgIHJlcGxhY2UoaSk7XG4gICAgICBpKys7XG4gICAgfSB3aGlsZSAoZGVwdGggPiAwKTtcbiAgfTtcblxuICB3aGlsZSAoaSA8IHRva2Vucy5sZW5ndGgpIHtcbiAgICBpZiAodGV4dChpKSA9PT0gJ2ZuJykgZnVuY3Rpb25BdCgpO1xuICAgIGVsc2UgaSsrO1xuICB9XG4gIHJldHVybiBlZGl0cztcbn1cbiJdLAogICJtYXBwaW5ncyI6ICI7QUFDQSxTQUFTLGNBQUFBLG1CQUFrQjtBQUMzQixTQUFTLGlCQUFBQyxzQkFBcUI7QUFFOUIsU0FBUyxvQkFBb0I7OztBQ0o2TixTQUFTLGlCQUFBQyxzQkFBcUI7QUFDeFIsU0FBUyxhQUFhOzs7QUNNdEIsU0FBUyxjQUFBQyxhQUFZLGdCQUFBQyxxQkFBb0I7QUFDekMsU0FBUyxTQUFTLFFBQUFDLE9BQU0sWUFBQUMsV0FBVSxTQUFTLFdBQVc7OztBQ0F0RCxTQUFTLFlBQVksY0FBYyxhQUFhLHFCQUFxQjtBQUNyRSxTQUFTLE1BQU0sZ0JBQWdCO0FBQy9CLFNBQVMscUJBQXFCOzs7QUNQdkIsSUFBTSxZQUFOLGNBQXdCLE1BQU07QUFBQSxFQUNuQyxPQUFPO0FBQ1Q7QUFFQSxJQUFNLFFBQVE7QUFRUCxTQUFTLFNBQVMsTUFBTSxNQUFNO0FBQ25DLFFBQU0sU0FBUyxDQUFDO0FBQ2hCLFFBQU0sV0FBVyxDQUFDO0FBQ2xCLFFBQU0sWUFBWTtBQUNsQixXQUFTLE9BQVEsUUFBUSxNQUFNLEtBQUssSUFBSSxLQUFLO0FBQzNDLFVBQU0sT0FBTyxNQUFNO0FBQ25CLFFBQUksTUFBTSxDQUFDLE1BQU0sTUFBTTtBQUVyQixVQUFJLFFBQVE7QUFDWixZQUFNLE9BQU87QUFDYixXQUFLLFlBQVk7QUFDakIsZUFBUyxPQUFRLFFBQVEsS0FBSyxLQUFLLElBQUksS0FBSztBQUMxQyxpQkFBUyxNQUFNLENBQUMsTUFBTSxPQUFPLElBQUk7QUFDakMsWUFBSSxVQUFVLEVBQUc7QUFBQSxNQUNuQjtBQUNBLFVBQUksVUFBVSxFQUFHLE1BQUssTUFBTSw0QkFBNEI7QUFDeEQsZUFBUyxLQUFLLEVBQUUsTUFBTSxJQUFJLEtBQUssVUFBVSxDQUFDO0FBQzFDLFlBQU0sWUFBWSxLQUFLO0FBQUEsSUFDekIsV0FBVyxNQUFNLENBQUMsRUFBRSxXQUFXLElBQUksRUFBRyxVQUFTLEtBQUssRUFBRSxNQUFNLElBQUksTUFBTSxVQUFVLENBQUM7QUFBQSxRQUM1RSxRQUFPLEtBQUssRUFBRSxNQUFNLE1BQU0sQ0FBQyxHQUFHLE1BQU0sSUFBSSxNQUFNLFVBQVUsQ0FBQztBQUFBLEVBQ2hFO0FBQ0EsU0FBTyxFQUFFLFFBQVEsU0FBUztBQUM1Qjs7O0FEckNBLElBQU0sbUNBQW1DO0FBQXFILElBQU0sMkNBQTJDO0FBYS9NLElBQU0sU0FBUztBQUNmLElBQU0sU0FBUztBQUNmLElBQU0sU0FBUztBQUdmLFNBQVMsU0FBUyxNQUFNO0FBQ3RCLFFBQU0sTUFBTSxTQUFTLEtBQUssSUFBSTtBQUM5QixTQUFPLE9BQU8sS0FBSyxRQUFRLE1BQU0sVUFBVSxXQUFXLEVBQUUsQ0FBQztBQUMzRDtBQVlPLFNBQVMsY0FBYyxNQUFNLE9BQU8sa0JBQWtCO0FBQzNELFFBQU0sU0FBUyxDQUFDLE9BQU8sS0FBSyxNQUFNLEdBQUcsRUFBRSxFQUFFLE1BQU0sSUFBSSxFQUFFO0FBQ3JELFFBQU0sT0FBTyxDQUFDLElBQUksWUFBWTtBQUM1QixVQUFNLElBQUksVUFBVSxHQUFHLElBQUksSUFBSSxPQUFPLEVBQUUsQ0FBQyxLQUFLLE9BQU8sR0FBRztBQUFBLEVBQzFEO0FBQ0EsUUFBTSxFQUFFLFFBQVEsU0FBUyxJQUFJLFNBQVMsTUFBTSxJQUFJO0FBQ2hELFFBQU0sV0FBVyw0QkFBNEIsS0FBSyxJQUFJO0FBQ3RELE1BQUksQ0FBQyxZQUFZLENBQUMsbUJBQW1CLE1BQU0sRUFBRyxRQUFPO0FBQ3JELE1BQUksT0FBTztBQUNYLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHO0FBQ2pDLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHLFFBQVEsS0FBSztBQUM5QyxRQUFNLE9BQU8sQ0FBQyxhQUFhO0FBQ3pCLFVBQU0sUUFBUSxPQUFPLElBQUk7QUFDekIsUUFBSSxVQUFVLFVBQWMsYUFBYSxVQUFhLE1BQU0sU0FBUztBQUNuRSxhQUFPLEtBQUssS0FBSyxHQUFHLElBQUksT0FBTyxRQUFRLFNBQVMsbUJBQW1CLFlBQVksTUFBTSxlQUFlO0FBQ3RHO0FBQ0EsV0FBTztBQUFBLEVBQ1Q7QUFHQSxRQUFNLE9BQU8sTUFBTTtBQUNqQixVQUFNLEtBQUssS0FBSztBQUNoQixVQUFNLE9BQU8sS0FBSyxFQUFFO0FBQ3BCLFFBQUksT0FBTyxLQUFLLElBQUksRUFBRyxRQUFPLEVBQUUsTUFBTSxVQUFVLFFBQVEsS0FBSztBQUM3RCxVQUFNLFNBQVMsT0FBTyxLQUFLLElBQUk7QUFDL0IsUUFBSSxRQUFRO0FBQ1YsVUFBSSxTQUFTLEVBQUUsR0FBRyxPQUFPLEdBQUcsT0FBTyxHQUFHLE9BQU8sR0FBRyxNQUFNLEVBQUUsT0FBTyxDQUFDLENBQUM7QUFDakUsVUFBSSxXQUFXLFVBQWEsS0FBSyxNQUFNLEtBQUs7QUFDMUMsYUFBSyxHQUFHO0FBQ1IsY0FBTSxRQUFRLEtBQUs7QUFDbkIsWUFBSSxNQUFNLFNBQVMsU0FBVSxNQUFLLElBQUksd0JBQXdCO0FBQzlELGlCQUFTLE1BQU07QUFDZixhQUFLLEdBQUc7QUFBQSxNQUNWO0FBQ0EsYUFBTyxFQUFFLE1BQU0sVUFBVSxPQUFPLE9BQU8sT0FBTyxDQUFDLENBQUMsR0FBRyxPQUFPO0FBQUEsSUFDNUQ7QUFDQSxRQUFJLFNBQVMsU0FBUztBQUNwQixVQUFJLEtBQUssTUFBTSxJQUFLLFFBQU8sRUFBRSxNQUFNLFFBQVE7QUFDM0MsV0FBSyxHQUFHO0FBQ1IsWUFBTSxVQUFVLEtBQUs7QUFDckIsVUFBSTtBQUNKLFVBQUksS0FBSyxNQUFNLEtBQUs7QUFDbEIsYUFBSyxHQUFHO0FBQ1IsY0FBTSxTQUFTLEtBQUs7QUFDcEIsWUFBSSxDQUFDLFVBQVUsS0FBSyxPQUFPLElBQUksRUFBRyxNQUFLLE9BQU8sTUFBTSxxQ0FBcUM7QUFDekYsZ0JBQVEsU0FBUyxPQUFPLElBQUk7QUFDNUIsWUFBSSxLQUFLLE1BQU0sSUFBSyxNQUFLLEdBQUc7QUFBQSxNQUM5QjtBQUNBLFdBQUssR0FBRztBQUNSLGFBQU8sRUFBRSxNQUFNLFNBQVMsU0FBUyxNQUFNO0FBQUEsSUFDekM7QUFDQSxXQUFPLEtBQUssSUFBSSxJQUFJLElBQUksK0VBQStFO0FBQUEsRUFDekc7QUFFQSxRQUFNLFFBQVEsQ0FBQyxJQUFJLE9BQU8sU0FBUyxXQUFXO0FBQzVDLFVBQU0sU0FBUyxTQUFTLEtBQUssT0FBTyxJQUFJLFFBQVEsS0FBSyxPQUFPLElBQUksQ0FBQyxJQUFJLFVBQVUsS0FBSyxPQUFPLElBQUksQ0FBQztBQUNoRyxVQUFNLE1BQU0sRUFBRSxHQUFHLE9BQU8sR0FBRyxPQUFPLEdBQUcsT0FBTyxHQUFHLE1BQU0sRUFBRSxNQUFNO0FBQzdELFVBQU0sS0FBSyxPQUFPO0FBQ2xCLFFBQUksUUFBUSxVQUFhLFdBQVcsVUFBYSxRQUFRLE9BQVEsTUFBSyxJQUFJLEdBQUcsT0FBTyxVQUFVLE1BQU0sRUFBRTtBQUN0RyxTQUFLLE9BQU8sU0FBUyxPQUFPLFVBQVUsQ0FBQyxPQUFPLFVBQVUsS0FBSyxFQUFHLE1BQUssSUFBSSxHQUFHLE9BQU8sVUFBVSxFQUFFLEVBQUU7QUFDakcsUUFBSSxPQUFPLE9BQVEsTUFBSyxJQUFJLEdBQUcsT0FBTyxhQUFhO0FBQ25ELFVBQU0sQ0FBQyxLQUFLLElBQUksSUFDZCxPQUFPLFFBQVEsQ0FBQyxHQUFHLEtBQUssS0FBSyxDQUFDLElBQUksT0FBTyxRQUFRLENBQUMsRUFBRSxLQUFLLEtBQUssS0FBSyxLQUFLLENBQUMsSUFBSSxDQUFDLGNBQWUsV0FBWTtBQUMzRyxRQUFJLFFBQVEsT0FBTyxRQUFRLEtBQU0sTUFBSyxJQUFJLEdBQUcsT0FBTyxrQkFBa0I7QUFBQSxFQUN4RTtBQUdBLFFBQU0sYUFBYSxDQUFDLFdBQVc7QUFDN0IsVUFBTSxLQUFLLEtBQUs7QUFDaEIsVUFBTSxRQUFRLEtBQUs7QUFDbkIsUUFBSSxVQUFVLFVBQVUsVUFBVSxTQUFTO0FBQ3pDLFVBQUksV0FBVyxVQUFhLE9BQU8sV0FBVyxPQUFRLE1BQUssSUFBSSxHQUFHLEtBQUssb0NBQW9DO0FBQzNHLFdBQUs7QUFDTCxhQUFPLEVBQUUsT0FBTyxVQUFVLFFBQVEsTUFBTSxVQUFVO0FBQUEsSUFDcEQ7QUFDQSxRQUFJLFVBQVUsT0FBTyxPQUFPLEtBQUssU0FBUyxFQUFFLEdBQUc7QUFDN0MsVUFBSSxXQUFXLFVBQWEsT0FBTyxTQUFTLFNBQVUsTUFBSyxJQUFJLDRDQUE0QztBQUMzRyxVQUFJLFVBQVUsSUFBSyxNQUFLO0FBQ3hCLFlBQU0sRUFBRSxNQUFNLFNBQVMsS0FBSyxJQUFJLEtBQUs7QUFDckMsVUFBSSxDQUFDLE9BQU8sS0FBSyxPQUFPLEVBQUcsTUFBSyxNQUFNLElBQUksT0FBTyxpQkFBaUI7QUFDbEUsWUFBTSxRQUFRLFVBQVUsTUFBTSxDQUFDLFNBQVMsT0FBTyxJQUFJLFNBQVMsT0FBTztBQUNuRSxZQUFNLE1BQU0sT0FBTyxTQUFTLFFBQVEsTUFBTTtBQUMxQyxhQUFPLEVBQUUsT0FBTyxNQUFNLFNBQVM7QUFBQSxJQUNqQztBQUNBLFVBQU0sUUFBUSxLQUFLO0FBQ25CLFFBQUksTUFBTSxTQUFTLFNBQVUsTUFBSyxJQUFJLDREQUE0RDtBQUNsRyxRQUFJLFdBQVcsVUFBYSxPQUFPLFNBQVMsTUFBTSxLQUFNLE1BQUssSUFBSSw4QkFBOEI7QUFDL0YsU0FBSyxHQUFHO0FBQ1IsVUFBTSxLQUFLLE1BQU0sU0FBUyxXQUFXLEVBQUUsTUFBTSxVQUFVLFFBQVEsTUFBTSxPQUFPLElBQUksTUFBTTtBQUN0RixVQUFNLFdBQVcsQ0FBQztBQUNsQixXQUFPLEtBQUssTUFBTSxLQUFLO0FBQ3JCLGVBQVMsS0FBSyxXQUFXLEVBQUUsQ0FBQztBQUM1QixVQUFJLEtBQUssTUFBTSxJQUFLLE1BQUssR0FBRztBQUFBLElBQzlCO0FBQ0EsU0FBSyxHQUFHO0FBQ1IsVUFBTSxRQUFRLE1BQU0sVUFBVSxRQUFRLFNBQVMsVUFBVSxPQUFPLFFBQVEsV0FBYyxTQUFTO0FBQy9GLFFBQUksU0FBUyxXQUFXLEtBQUssU0FBUyxXQUFXO0FBQy9DLFdBQUssSUFBSSxHQUFHLFNBQVMsTUFBTSx1QkFBdUIsU0FBUyxNQUFNLGVBQWU7QUFDbEYsVUFBTSxVQUFVLFNBQVMsQ0FBQyxFQUFFO0FBQzVCLFFBQUksU0FBUyxLQUFLLENBQUMsRUFBRSxNQUFNLE1BQU0sTUFBTSxVQUFVLE9BQU8sRUFBRyxNQUFLLElBQUksbUNBQW1DO0FBQ3ZHLFdBQU87QUFBQSxNQUNMLE9BQU8sU0FBUyxJQUFJLENBQUMsRUFBRSxNQUFNLE1BQU0sS0FBSztBQUFBLE1BQ3hDLE1BQ0UsTUFBTSxTQUFTLFdBQ1gsYUFBYSxTQUFTLElBQUksTUFBTSxPQUFPLEVBQUUsS0FBSyxJQUFJLENBQUMsTUFDbkQsWUFBWSxRQUFRLEtBQUssT0FBTyxJQUFJLFVBQVUsSUFBSSxPQUFPLEdBQUc7QUFBQSxJQUNwRTtBQUFBLEVBQ0Y7QUFFQSxRQUFNLFlBQVksQ0FBQztBQUNuQixTQUFPLE9BQU8sT0FBTyxRQUFRO0FBQzNCLFVBQU0sS0FBSyxLQUFLO0FBQ2hCLFFBQUksS0FBSyxNQUFNO0FBQ2IsV0FBSyxJQUFJLElBQUksS0FBSyxDQUFDLDZFQUE2RTtBQUNsRyxTQUFLO0FBQ0wsVUFBTSxPQUFPLEtBQUs7QUFDbEIsUUFBSSxVQUFVLEtBQUssQ0FBQyxVQUFVLE1BQU0sU0FBUyxLQUFLLElBQUksRUFBRyxNQUFLLEtBQUssTUFBTSxHQUFHLEtBQUssSUFBSSxvQkFBb0I7QUFDekcsUUFBSTtBQUNKLFFBQUksS0FBSyxNQUFNLEtBQUs7QUFDbEIsV0FBSztBQUNMLGlCQUFXLEtBQUs7QUFBQSxJQUNsQjtBQUNBLFNBQUssR0FBRztBQUNSLFVBQU0sUUFBUSxXQUFXLFFBQVE7QUFDakMsUUFBSSxLQUFLLE1BQU0sSUFBSyxNQUFLLEtBQUssR0FBRyxJQUFJLEtBQUssS0FBSyxTQUFTLCtDQUErQztBQUN2RyxTQUFLLEdBQUc7QUFDUixjQUFVLEtBQUssRUFBRSxNQUFNLEtBQUssTUFBTSxHQUFHLE9BQU8sS0FBSyxjQUFjLE1BQU0sVUFBVSxFQUFFLEdBQUcsTUFBTSxPQUFPLEVBQUUsRUFBRSxDQUFDO0FBQUEsRUFDeEc7QUFDQSxNQUFJLFVBQVUsV0FBVyxFQUFHLE1BQUssR0FBRyxzQkFBc0I7QUFDMUQsU0FBTztBQUNUO0FBR0EsU0FBUyxtQkFBbUIsUUFBUTtBQUNsQyxNQUFJLE9BQU8sV0FBVyxFQUFHLFFBQU87QUFDaEMsTUFBSSxTQUFTO0FBQ2IsYUFBVyxFQUFFLEtBQUssS0FBSyxRQUFRO0FBQzdCLFFBQUksVUFBVSxTQUFTLFFBQVMsUUFBTztBQUN2QyxhQUFTLFNBQVM7QUFBQSxFQUNwQjtBQUNBLFNBQU87QUFDVDtBQUdBLFNBQVMsY0FBYyxNQUFNLFVBQVUsSUFBSTtBQUN6QyxRQUFNLFFBQVEsQ0FBQztBQUNmLE1BQUksUUFBUSxLQUFLLFlBQVksTUFBTSxLQUFLLENBQUMsSUFBSTtBQUM3QyxhQUFXLEVBQUUsTUFBTSxHQUFHLEtBQUssQ0FBQyxHQUFHLFFBQVEsRUFBRSxRQUFRLEdBQUc7QUFDbEQsUUFBSSxRQUFRLEdBQUk7QUFDaEIsVUFBTSxRQUFRLEtBQUssWUFBWSxNQUFNLE9BQU8sQ0FBQyxJQUFJO0FBQ2pELFFBQUksS0FBSyxNQUFNLFNBQVMsS0FBSyxNQUFNLE9BQU8sSUFBSSxFQUFFLEtBQUssTUFBTSxNQUFNLENBQUMsS0FBSyxXQUFXLE1BQU0sSUFBSSxFQUFHO0FBQy9GLFVBQU0sUUFBUSxLQUFLLE1BQU0sT0FBTyxHQUFHLEVBQUUsRUFBRSxLQUFLLENBQUM7QUFDN0MsWUFBUTtBQUFBLEVBQ1Y7QUFDQSxTQUFPLE1BQU0sS0FBSyxJQUFJO0FBQ3hCO0FBR08sSUFBTSxvQkFBb0IsQ0FBQyxjQUNoQyxnQkFBZ0IsVUFBVSxJQUFJLENBQUMsRUFBRSxNQUFNLE1BQU0sTUFBTSxHQUFHLElBQUksTUFBTSxLQUFLLFVBQVUsS0FBSyxDQUFDLEVBQUUsRUFBRSxLQUFLLElBQUksQ0FBQztBQUFBO0FBTTlGLFNBQVMsaUJBQWlCLE1BQU0sTUFBTTtBQUMzQyxRQUFNLFFBQVEsQ0FBQyxrREFBa0QsRUFBRTtBQUNuRSxhQUFXLEVBQUUsTUFBTSxNQUFNLElBQUksS0FBSyxjQUFjLE1BQU0sSUFBSSxHQUFHO0FBQzNELFVBQU0sT0FBTyxJQUFJLE1BQU0sSUFBSTtBQUMzQixRQUFJLFFBQVEsTUFBTSxLQUFLLFdBQVcsRUFBRyxPQUFNLEtBQUssT0FBTyxHQUFHLEtBQUs7QUFBQSxhQUN0RCxRQUFRLEdBQUksT0FBTSxLQUFLLE9BQU8sR0FBRyxLQUFLLElBQUksQ0FBQyxTQUFTLE1BQU0sSUFBSSxHQUFHLFFBQVEsQ0FBQyxHQUFHLEtBQUs7QUFDM0YsVUFBTSxLQUFLLGdCQUFnQixJQUFJLEtBQUssSUFBSSxHQUFHO0FBQUEsRUFDN0M7QUFDQSxTQUFPLEdBQUcsTUFBTSxLQUFLLElBQUksQ0FBQztBQUFBO0FBQUE7QUFBQTtBQUFBO0FBQzVCO0FBR08sSUFBTSxrQkFBa0IsQ0FBQyxTQUFTLEdBQUcsSUFBSTtBQUd6QyxTQUFTLGNBQWMsTUFBTTtBQUNsQyxTQUFPLFlBQVksS0FBSyxNQUFNLFVBQVUsQ0FBQyxFQUN0QyxJQUFJLENBQUMsU0FBUyxLQUFLLE1BQU0sWUFBWSxNQUFNLEtBQUssQ0FBQyxFQUNqRCxPQUFPLENBQUMsV0FBVyxXQUFXLE1BQU0sQ0FBQyxFQUNyQyxRQUFRLENBQUMsV0FBVyxZQUFZLFFBQVEsRUFBRSxXQUFXLE1BQU0sVUFBVSxPQUFPLENBQUMsRUFBRSxJQUFJLENBQUMsU0FBUyxLQUFLLFFBQVEsSUFBSSxDQUFDLENBQUMsRUFDaEgsT0FBTyxDQUFDLFNBQVMsS0FBSyxTQUFTLE9BQU8sS0FBSyxjQUFjLGFBQWEsTUFBTSxNQUFNLEdBQUcsSUFBSSxNQUFNLE1BQVMsRUFDeEcsS0FBSztBQUNWO0FBRUEsSUFBSSxRQUFRLEtBQUssQ0FBQyxNQUFNLGNBQWMsd0NBQWUsR0FBRztBQUN0RCxRQUFNLE9BQU8sS0FBSyxrQ0FBcUIsT0FBTztBQUM5QyxhQUFXLFFBQVEsY0FBYyxJQUFJLEdBQUc7QUFDdEMsa0JBQWMsZ0JBQWdCLElBQUksR0FBRyxpQkFBaUIsYUFBYSxNQUFNLE1BQU0sR0FBRyxJQUFJLENBQUM7QUFDdkYsWUFBUSxPQUFPLE1BQU0sR0FBRyxTQUFTLE1BQU0sZ0JBQWdCLElBQUksQ0FBQyxDQUFDO0FBQUEsQ0FBSTtBQUFBLEVBQ25FO0FBQ0Y7OztBRS9OQSxJQUFNLFdBQVcsb0JBQUksSUFBSSxDQUFDLEtBQUssTUFBTSxNQUFNLE1BQU0sTUFBTSxNQUFNLElBQUksQ0FBQztBQUdsRSxVQUFVLGFBQWE7QUFDckIsUUFBTSxVQUFVO0FBQ2hCLGFBQVcsVUFBVSxRQUFTLE9BQU07QUFDcEMsYUFBVyxTQUFTLFFBQVMsWUFBVyxVQUFVLFFBQVMsT0FBTSxRQUFRO0FBQzNFO0FBTU8sU0FBUyxjQUFjLFFBQVE7QUFDcEMsUUFBTSxRQUFRLENBQUM7QUFDZixRQUFNLGNBQWMsSUFBSSxJQUFJLE9BQU8sSUFBSSxDQUFDLEVBQUUsTUFBQUMsTUFBSyxNQUFNQSxLQUFJLENBQUM7QUFDMUQsUUFBTSxPQUFPLENBQUNDLE9BQU0sT0FBT0EsRUFBQyxHQUFHO0FBQy9CLE1BQUksSUFBSTtBQUdSLFFBQU0sZUFBZSxDQUFDLE9BQU87QUFDM0IsUUFBSSxRQUFRO0FBQ1osT0FBRztBQUNELFVBQUksTUFBTSxTQUFTLEtBQUssRUFBRSxDQUFDLEVBQUc7QUFDOUIsVUFBSSxNQUFNLFNBQVMsS0FBSyxFQUFFLENBQUMsRUFBRztBQUM5QjtBQUFBLElBQ0YsU0FBUyxRQUFRLEtBQUssS0FBSyxPQUFPO0FBQ2xDLFdBQU87QUFBQSxFQUNUO0FBRUEsUUFBTSxhQUFhLE1BQU07QUFDdkIsVUFBTSxRQUFRLG9CQUFJLElBQUk7QUFDdEIsVUFBTSxhQUFhLFdBQVc7QUFDOUIsVUFBTSxXQUFXLENBQUMsU0FBUztBQUN6QixVQUFJLFFBQVEsTUFBTSxJQUFJLElBQUk7QUFDMUIsYUFBTyxVQUFVLFFBQVc7QUFDMUIsY0FBTSxFQUFFLE1BQU0sSUFBSSxXQUFXLEtBQUs7QUFDbEMsWUFBSSxVQUFVLE9BQVcsU0FBUTtBQUFBLGlCQUN4QixDQUFDLFlBQVksSUFBSSxLQUFLLEtBQUssQ0FBQyxTQUFTLElBQUksS0FBSyxFQUFHLFNBQVE7QUFBQSxNQUNwRTtBQUNBLFlBQU0sSUFBSSxNQUFNLEtBQUs7QUFDckIsYUFBTztBQUFBLElBQ1Q7QUFFQSxVQUFNLFNBQVMsQ0FBQyxvQkFBSSxJQUFJLENBQUM7QUFDekIsVUFBTSxVQUFVLENBQUMsU0FBUyxPQUFPLEdBQUcsRUFBRSxFQUFFLElBQUksSUFBSTtBQUNoRCxVQUFNLFVBQVUsQ0FBQyxPQUFPO0FBQ3RCLFlBQU0sRUFBRSxNQUFNLE1BQU0sTUFBTSxHQUFHLElBQUksT0FBTyxFQUFFO0FBQzFDLFlBQU0sUUFBUSxTQUFTLElBQUk7QUFDM0IsVUFBSSxNQUFNLFNBQVMsS0FBSyxPQUFRLE9BQU0sS0FBSyxFQUFFLE1BQU0sSUFBSSxNQUFNLE1BQU0sQ0FBQztBQUFBLElBQ3RFO0FBRUEsVUFBTSxnQkFBZ0IsTUFBTTtBQUMxQixXQUFLO0FBQ0wsVUFBSSxLQUFLLENBQUMsTUFBTSxJQUFLLEtBQUksYUFBYSxDQUFDO0FBQUEsSUFDekM7QUFFQSxTQUFLO0FBRUwsYUFBU0MsU0FBUSxPQUFNO0FBQ3JCLFlBQU0sUUFBUSxLQUFLLENBQUM7QUFDcEIsVUFBSSxVQUFVLEtBQUs7QUFDakIsc0JBQWM7QUFDZDtBQUFBLE1BQ0Y7QUFDQSxVQUFJLFVBQVUsT0FBTyxVQUFVLElBQUssQ0FBQUE7QUFDcEMsVUFBSSxVQUFVLE9BQU8sVUFBVSxJQUFLLENBQUFBO0FBQ3BDLFVBQUlBLFdBQVUsS0FBSyxLQUFLLElBQUksQ0FBQyxNQUFNLE9BQU8sYUFBYSxLQUFLLEtBQUssR0FBRztBQUNsRSxnQkFBUSxLQUFLO0FBQ2IsZ0JBQVEsQ0FBQztBQUFBLE1BQ1g7QUFDQTtBQUNBLFVBQUlBLFdBQVUsRUFBRztBQUFBLElBQ25CO0FBQ0EsV0FBTyxLQUFLLENBQUMsTUFBTSxJQUFLLE1BQUs7QUFHN0IsUUFBSSxVQUFVLENBQUM7QUFFZixVQUFNLFFBQVEsQ0FBQztBQUNmLFFBQUksUUFBUTtBQUNaLFVBQU0sU0FBUyxNQUFNO0FBQ25CLGNBQVEsUUFBUSxPQUFPO0FBQ3ZCLGdCQUFVLENBQUM7QUFBQSxJQUNiO0FBQ0EsUUFBSSxRQUFRO0FBQ1osT0FBRztBQUNELFlBQU0sUUFBUSxLQUFLLENBQUM7QUFDcEIsVUFBSSxVQUFVLEtBQUs7QUFDakIsc0JBQWM7QUFDZDtBQUFBLE1BQ0Y7QUFDQSxVQUFJLFVBQVUsT0FBTztBQUNuQixlQUFPLEtBQUssb0JBQUksSUFBSSxDQUFDO0FBQ3JCLGNBQU0sS0FBSyxFQUFFLE9BQU8sTUFBTSxDQUFDO0FBQUEsTUFDN0IsV0FBVyxVQUFVLElBQUs7QUFBQSxlQUNqQixVQUFVLElBQUs7QUFBQSxlQUNmLFVBQVUsSUFBSyxRQUFPO0FBQUEsZUFDdEIsVUFBVSxLQUFLO0FBQ3RCLGVBQU87QUFDUDtBQUNBLGVBQU8sS0FBSyxvQkFBSSxJQUFJLENBQUM7QUFBQSxNQUN2QixXQUFXLFVBQVUsS0FBSztBQUN4QixlQUFPO0FBQ1A7QUFDQSxlQUFPLElBQUk7QUFDWCxZQUFJLE1BQU0sR0FBRyxFQUFFLEdBQUcsVUFBVSxTQUFTLE1BQU0sR0FBRyxFQUFFLEVBQUUsVUFBVSxPQUFPO0FBQ2pFLGdCQUFNLElBQUk7QUFDVixpQkFBTyxJQUFJO0FBQUEsUUFDYjtBQUFBLE1BQ0YsV0FBVyxvQkFBb0IsS0FBSyxLQUFLLEdBQUc7QUFDMUMsWUFBSSxLQUFLLElBQUk7QUFDYixZQUFJLEtBQUssRUFBRSxNQUFNLElBQUssUUFBTyxLQUFLLElBQUksTUFBTSxJQUFJO0FBQ2hELGdCQUFRLEtBQUssS0FBSyxFQUFFLENBQUM7QUFFckIsZ0JBQVEsRUFBRTtBQUNWLFlBQUk7QUFBQSxNQUNOLFdBQVcsYUFBYSxLQUFLLEtBQUssS0FBSyxLQUFLLElBQUksQ0FBQyxNQUFNLE9BQU8sT0FBTyxLQUFLLENBQUMsVUFBVSxNQUFNLElBQUksS0FBSyxDQUFDO0FBQ25HLGdCQUFRLENBQUM7QUFDWDtBQUFBLElBQ0YsU0FBUyxRQUFRO0FBQUEsRUFDbkI7QUFFQSxTQUFPLElBQUksT0FBTyxRQUFRO0FBQ3hCLFFBQUksS0FBSyxDQUFDLE1BQU0sS0FBTSxZQUFXO0FBQUEsUUFDNUI7QUFBQSxFQUNQO0FBQ0EsU0FBTztBQUNUOzs7QUh0SEEsSUFBTSxVQUFVLEVBQUUsS0FBSyxLQUFLLEtBQUssS0FBSyxLQUFLLEtBQUssS0FBSyxJQUFJO0FBWWxELFNBQVMsVUFBVSxNQUFNLE9BQU8sZUFBZTtBQUNwRCxRQUFNLE9BQU8sQ0FBQyxJQUFJLFlBQVk7QUFDNUIsVUFBTSxJQUFJLFVBQVUsR0FBRyxJQUFJLElBQUksS0FBSyxNQUFNLEdBQUcsRUFBRSxFQUFFLE1BQU0sSUFBSSxFQUFFLE1BQU0sS0FBSyxPQUFPLEdBQUc7QUFBQSxFQUNwRjtBQUNBLFFBQU0sRUFBRSxRQUFRLFNBQVMsSUFBSSxTQUFTLE1BQU0sSUFBSTtBQUNoRCxRQUFNLFVBQVUsQ0FBQztBQUNqQixRQUFNLFFBQVEsQ0FBQztBQUNmLE1BQUksT0FBTztBQUNYLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHO0FBQ2pDLFFBQU0sT0FBTyxNQUFNLE9BQU8sSUFBSSxHQUFHLFFBQVEsS0FBSztBQUM5QyxRQUFNLE9BQU8sQ0FBQyxhQUFhO0FBQ3pCLFVBQU0sUUFBUSxPQUFPLElBQUk7QUFDekIsUUFBSSxDQUFDLE1BQU8sUUFBTyxLQUFLLEtBQUssUUFBUSxXQUFXLElBQUksUUFBUSw0QkFBNEIsd0JBQXdCO0FBQ2hILFFBQUksYUFBYSxVQUFhLE1BQU0sU0FBUztBQUMzQyxXQUFLLE1BQU0sTUFBTSxJQUFJLE1BQU0sSUFBSSxtQkFBbUIsUUFBUSxlQUFlO0FBQzNFO0FBQ0EsV0FBTztBQUFBLEVBQ1Q7QUFDQSxRQUFNLFlBQVksTUFBTSxPQUFPLE9BQU8sQ0FBQyxFQUFFO0FBR3pDLFFBQU0sY0FBYyxNQUFNO0FBQ3hCLFVBQU0sT0FBTyxLQUFLO0FBQ2xCLGVBQVcsUUFBUSxRQUFRLEtBQUssSUFBSSxHQUFHLEtBQUssTUFBTSxRQUFRLFdBQVU7QUFDcEUsU0FBSztBQUFBLEVBQ1A7QUFDQSxRQUFNLFlBQVksTUFBTTtBQUN0QixRQUFJLEtBQUssTUFBTSxPQUFXLE1BQUssS0FBSyxRQUFRLG1DQUFtQztBQUMvRSxRQUFJLEtBQUssTUFBTSxPQUFPLG1CQUFtQixLQUFLLE9BQU8sT0FBTyxDQUFDLEdBQUcsUUFBUSxFQUFFO0FBQ3hFO0FBQUEsUUFDRSxLQUFLO0FBQUEsUUFDTCxJQUFJLE9BQU8sT0FBTyxDQUFDLEVBQUUsSUFBSTtBQUFBLE1BQzNCO0FBQ0YsUUFBSSxLQUFLLEtBQUssV0FBVyxLQUFLLE1BQU0sSUFBSyxhQUFZO0FBQUEsUUFDaEQsTUFBSztBQUFBLEVBQ1o7QUFDQSxRQUFNLFNBQVMsSUFBSSxTQUFTO0FBQzFCLFdBQU8sQ0FBQyxLQUFLLFNBQVMsS0FBSyxDQUFDLEVBQUcsV0FBVTtBQUFBLEVBQzNDO0FBR0EsUUFBTSxZQUFZLE1BQU07QUFDdEIsVUFBTSxPQUFPLEtBQUssR0FBRyxFQUFFO0FBQ3ZCLFVBQU0sUUFBUSxDQUFDO0FBQ2YsT0FBRztBQUNELFVBQUksTUFBTSxTQUFTLEVBQUcsTUFBSyxJQUFJO0FBQy9CLFVBQUksVUFBVTtBQUNkLGFBQU8sS0FBSyxNQUFNLEtBQUs7QUFDckIsYUFBSztBQUNMLGtCQUFVLENBQUM7QUFBQSxNQUNiO0FBQ0EsWUFBTSxPQUFPLEtBQUs7QUFDbEIsVUFBSSxDQUFDLGlCQUFpQixLQUFLLEtBQUssSUFBSTtBQUNsQztBQUFBLFVBQ0UsS0FBSztBQUFBLFVBQ0w7QUFBQSxRQUNGO0FBQ0YsWUFBTSxLQUFLLEdBQUcsVUFBVSxNQUFNLEVBQUUsR0FBRyxLQUFLLElBQUksRUFBRTtBQUFBLElBQ2hELFNBQVMsS0FBSyxNQUFNO0FBQ3BCLFFBQUksS0FBSyxNQUFNO0FBQ2I7QUFBQSxRQUNFO0FBQUEsUUFDQTtBQUFBLE1BQ0Y7QUFDRixTQUFLLEdBQUc7QUFDUixXQUFPLE1BQU0sS0FBSyxJQUFJO0FBQUEsRUFDeEI7QUFHQSxRQUFNLGFBQWEsTUFBTTtBQUN2QixRQUFJO0FBQ0osV0FBTyxLQUFLLE1BQU0sS0FBSztBQUNyQixZQUFNLEVBQUUsS0FBSyxJQUFJLEtBQUssR0FBRztBQUN6QixZQUFNLE9BQU8sS0FBSztBQUNsQixVQUFJLG1CQUFtQixLQUFLLEtBQUssSUFBSSxHQUFHO0FBQ3RDLFlBQUksS0FBTSxNQUFLLE1BQU0sZ0RBQWdEO0FBQ3JFLGVBQU8sRUFBRSxNQUFNLEtBQUssTUFBTSxNQUFNLFdBQVcsS0FBSyxTQUFTLFNBQVMsU0FBWSxVQUFVLEdBQUcsSUFBSSxFQUFFO0FBQ2pHLGFBQUssS0FBSyxVQUFVO0FBQUEsTUFDdEIsV0FBVyxLQUFLLE1BQU0sSUFBSyxhQUFZO0FBQUEsSUFDekM7QUFDQSxXQUFPO0FBQUEsRUFDVDtBQUVBLFFBQU0sYUFBYSxDQUFDLFNBQVM7QUFDM0IsVUFBTSxRQUFRLENBQUM7QUFDZixVQUFNLFNBQVMsQ0FBQyxXQUFXO0FBQ3pCLFVBQUksS0FBSyxNQUFNLEtBQUs7QUFDbEIsYUFBSyxHQUFHO0FBQ1IsZUFBTyxLQUFLLE1BQU0sS0FBSztBQUNyQixpQkFBTyxNQUFNO0FBQ2IsY0FBSSxLQUFLLE1BQU0sSUFBSyxNQUFLLEdBQUc7QUFBQSxRQUM5QjtBQUNBLGFBQUssR0FBRztBQUNSO0FBQUEsTUFDRjtBQUNBLFlBQU0sT0FBTyxLQUFLO0FBQ2xCLFVBQUksQ0FBQyxpQkFBaUIsS0FBSyxLQUFLLElBQUksRUFBRyxNQUFLLEtBQUssTUFBTSxJQUFJLEtBQUssSUFBSSx3QkFBd0I7QUFDNUYsVUFBSSxLQUFLLE1BQU0sTUFBTTtBQUNuQixhQUFLLElBQUk7QUFDVCxlQUFPLENBQUMsR0FBRyxRQUFRLEtBQUssSUFBSSxDQUFDO0FBQUEsTUFDL0IsV0FBVyxLQUFLLE1BQU0sS0FBTSxNQUFLLEtBQUssR0FBRyxtRUFBbUU7QUFBQSxVQUN2RyxPQUFNLEtBQUssRUFBRSxNQUFNLFFBQVEsTUFBTSxLQUFLLE1BQU0sSUFBSSxLQUFLLEtBQUssQ0FBQztBQUFBLElBQ2xFO0FBQ0EsV0FBTyxJQUFJO0FBQ1gsV0FBTztBQUFBLEVBQ1Q7QUFFQSxRQUFNLGtCQUFrQixDQUFDLE1BQU0sU0FBUztBQUN0QyxRQUFJLFNBQVMsS0FBSyxTQUFTLFFBQVEsS0FBSyxVQUFVLFNBQVMsR0FBRztBQUM1RCxXQUFLLE1BQU0sK0NBQStDO0FBQzVELFNBQUssUUFBUTtBQUNiLGVBQVcsRUFBRSxNQUFNLE1BQU0sR0FBRyxLQUFLLFdBQVcsQ0FBQyxDQUFDLEdBQUc7QUFDL0MsVUFBSSxLQUFLLFdBQVcsRUFBRyxNQUFLLElBQUksV0FBVyxJQUFJLG1CQUFtQjtBQUNsRSxjQUFRLEtBQUssRUFBRSxNQUFNLE1BQU0sTUFBTSxNQUFNLFdBQVcsTUFBTSxLQUFLLE1BQU0sR0FBRyxFQUFFLEVBQUUsTUFBTSxJQUFJLEVBQUUsT0FBTyxDQUFDO0FBQUEsSUFDaEc7QUFDQSxTQUFLLEdBQUc7QUFFUixVQUFNLEtBQUssRUFBRSxNQUFNLElBQUksVUFBVSxHQUFHLE1BQU0sS0FBSyxNQUFNLE1BQU0sVUFBVSxDQUFDLEVBQUUsUUFBUSxXQUFXLEVBQUUsRUFBRSxDQUFDO0FBQUEsRUFDbEc7QUFFQSxRQUFNLFFBQVEsTUFBTTtBQUNsQixTQUFLLEdBQUc7QUFDUixhQUFTLFdBQVcsR0FBRztBQUN2QixTQUFLLEdBQUc7QUFBQSxFQUNWO0FBRUEsUUFBTSxjQUFjLE1BQU07QUFDeEIsUUFBSSxLQUFLLE1BQU0sTUFBTTtBQUNuQixXQUFLO0FBQ0wsV0FBSztBQUNMLFdBQUssR0FBRztBQUNSLGVBQVMsT0FBTyxHQUFHLEdBQUcsR0FBRztBQUN6QixXQUFLLEdBQUc7QUFDUixhQUFPLEdBQUc7QUFDVixZQUFNO0FBQUEsSUFDUixXQUFXLEtBQUssTUFBTSxVQUFVO0FBQzlCLFdBQUs7QUFDTCxXQUFLO0FBQ0wsV0FBSyxHQUFHO0FBQ1IsZUFBUyxPQUFPLEdBQUcsR0FBRyxHQUFHO0FBQ3pCLFdBQUssR0FBRztBQUNSLFVBQUksS0FBSyxNQUFNLElBQUssTUFBSztBQUFBLElBQzNCLE9BQU87QUFDTCxVQUFJLEtBQUssTUFBTSxJQUFLLFFBQU8sR0FBRztBQUM5QixXQUFLLEdBQUc7QUFBQSxJQUNWO0FBQUEsRUFDRjtBQUdBLFFBQU0sU0FBUyxDQUFDLFVBQVUsTUFBTTtBQUM5QixRQUFJLFFBQVE7QUFDWixXQUFPLFFBQVEsS0FBTSxLQUFLLE1BQU0sT0FBTyxLQUFLLE1BQU0sT0FBUTtBQUN4RCxVQUFJLEtBQUssTUFBTSxJQUFLO0FBQ3BCLFVBQUksS0FBSyxNQUFNLElBQUs7QUFDcEIsZ0JBQVU7QUFBQSxJQUNaO0FBQ0EsUUFBSSxLQUFLLE1BQU0sSUFBSyxNQUFLO0FBQUEsRUFDM0I7QUFFQSxRQUFNLFNBQVMsTUFBTTtBQUNuQixRQUFJLEtBQUssTUFBTSxVQUFVLEtBQUssTUFBTSxVQUFXLE1BQUssS0FBSyxHQUFHLElBQUksS0FBSyxDQUFDLG1DQUFtQztBQUN6RyxXQUFPLEdBQUc7QUFDVixVQUFNO0FBQUEsRUFDUjtBQUVBLFFBQU0sWUFBWSxNQUFNO0FBQ3RCLFlBQVEsS0FBSyxHQUFHO0FBQUEsTUFDZCxLQUFLO0FBQ0gsZUFBTyxNQUFNO0FBQUEsTUFDZixLQUFLO0FBQUEsTUFDTCxLQUFLO0FBQUEsTUFDTCxLQUFLO0FBQ0gsYUFBSztBQUNMLGVBQU8sR0FBRztBQUNWLGNBQU07QUFDTixlQUFPLEtBQUssTUFBTSxRQUFRO0FBQ3hCLGVBQUs7QUFDTCxpQkFBTyxHQUFHO0FBQ1YsZ0JBQU07QUFBQSxRQUNSO0FBQ0EsZUFBTztBQUFBLE1BQ1QsS0FBSztBQUFBLE1BQ0wsS0FBSztBQUNILGFBQUs7QUFDTCxlQUFPLEdBQUc7QUFDVixlQUFPLE1BQU07QUFBQSxNQUNmLEtBQUs7QUFDSCxhQUFLO0FBQ0wsZUFBTyxHQUFHO0FBQ1YsYUFBSyxHQUFHO0FBQ1IsaUJBQVMsUUFBUSxHQUFHO0FBQ3BCLGFBQUssR0FBRztBQUNSLGVBQU87QUFBQSxNQUNUO0FBQ0UsZUFBTyxLQUFLLEdBQUc7QUFDZixhQUFLLEdBQUc7QUFDUixlQUFPO0FBQUEsSUFDWDtBQUFBLEVBQ0Y7QUFHQSxRQUFNLFdBQVcsQ0FBQyxTQUFTLFVBQVU7QUFFbkMsUUFBSSxPQUFPO0FBQ1gsUUFBSSxNQUFNO0FBQ1YsUUFBSTtBQUNKLFVBQU0sYUFBYSxNQUFNO0FBQ3ZCLFVBQUksT0FBTztBQUNULGNBQU0sS0FBSyxFQUFFLE1BQU0sS0FBSyxJQUFJLEtBQUssTUFBTSxHQUFHLFdBQVcsT0FBTyxJQUFJLENBQUMsR0FBRyxLQUFLLEtBQUssS0FBSyxHQUFHLEtBQUssRUFBRSxJQUFJLE1BQU0sRUFBRSxHQUFHLENBQUM7QUFDL0csYUFBTztBQUNQLGNBQVE7QUFBQSxJQUNWO0FBQ0EsV0FBTyxLQUFLLE1BQU0sT0FBTztBQUN2QixVQUFJLEtBQUssTUFBTSxPQUFXLE1BQUssS0FBSyxRQUFRLElBQUksS0FBSyx5QkFBeUI7QUFDOUUsWUFBTSxPQUFPLEtBQUs7QUFDbEIsWUFBTSxPQUFPLFdBQVc7QUFFeEIsWUFBTSxTQUFTLE1BQU0sU0FBUyxRQUFRLEtBQUssY0FBYyxTQUFTLEtBQUssTUFBTTtBQUM3RSxXQUFLLENBQUMsUUFBUSxLQUFLLFNBQVMsU0FBUyxDQUFDLE9BQVEsWUFBVztBQUN6RCxVQUFJLEtBQUssTUFBTSxZQUFZLFVBQVUsUUFBVztBQUM5Qyx3QkFBZ0IsTUFBTSxJQUFJO0FBQzFCO0FBQUEsTUFDRjtBQUNBLFVBQUksTUFBTTtBQUNSLFlBQUksS0FBSyxTQUFTLFFBQVEsU0FBUyxFQUFHLE1BQUssS0FBSyxNQUFNLElBQUksS0FBSyxJQUFJLHdCQUF3QjtBQUMzRixjQUFNLFFBQVEsS0FBSyxTQUFTLE9BQU8sS0FBSztBQUN4QyxjQUFNLE1BQU0sS0FBSyxLQUFLLEtBQUssS0FBSyxFQUFFLEtBQUssR0FBRyxJQUFJLEtBQUs7QUFDbkQsY0FBTSxRQUFRLFNBQVMsS0FBSyxHQUFHLEtBQUssR0FBRyxLQUFLLGNBQWMsU0FBWSxLQUFLLFNBQVMsS0FBSyxTQUFTLEVBQUU7QUFDcEcsY0FBTSxLQUFLLEVBQUUsTUFBTSxLQUFLLE1BQU0sSUFBSSxLQUFLLElBQUksTUFBTSxHQUFHLEtBQUssR0FBRyxHQUFHLEdBQUcsQ0FBQztBQUNuRSxZQUFJLEtBQUssY0FBYyxVQUFhLENBQUMsT0FBUTtBQUM3QyxnQkFBUSxLQUFLLFNBQVMsT0FBTyxLQUFLLFlBQVk7QUFBQSxNQUNoRDtBQUNBLGNBQVE7QUFDUixZQUFNLFVBQVU7QUFDaEIsVUFBSSxNQUFNLFNBQVMsT0FBUSxZQUFXO0FBQUEsSUFDeEM7QUFDQSxlQUFXO0FBQUEsRUFDYjtBQUVBLFdBQVMsYUFBYSxNQUFTO0FBQy9CLGFBQVcsRUFBRSxNQUFNLEdBQUcsS0FBSztBQUN6QixRQUFJLEtBQUssTUFBTSxNQUFNLEVBQUUsRUFBRSxTQUFTLEtBQUssRUFBRyxNQUFLLE1BQU0sa0RBQWtEO0FBQ3pHLFNBQU8sRUFBRSxTQUFTLE9BQU8sVUFBVSxPQUFPO0FBQzVDO0FBRUEsSUFBTSxXQUFXO0FBTVYsU0FBUyxRQUFRLE1BQU07QUFDNUIsTUFBSSxLQUFLLFNBQVMsSUFBSSxFQUFHLFFBQU87QUFDaEMsUUFBTSxTQUFTLEtBQUssUUFBUSx3QkFBd0IsQ0FBQyxRQUFRLFFBQVEsVUFBVTtBQUM3RSxVQUFNLFlBQVksS0FBSyxLQUFLLE1BQU0sS0FBSyxLQUFLLEtBQUssS0FBSztBQUN0RCxXQUFPLGFBQWMsU0FBUyxLQUFLLE1BQU0sS0FBSyxTQUFTLEtBQUssS0FBSyxJQUFLLFNBQVM7QUFBQSxFQUNqRixDQUFDO0FBRUQsU0FBTyxPQUFPLFFBQVEseUJBQXlCLEVBQUUsRUFBRSxRQUFRLHdCQUF3QixFQUFFO0FBQ3ZGO0FBR0EsSUFBTSxlQUFlLENBQUMsU0FDcEIsS0FDRyxNQUFNLGtDQUFrQyxFQUN4QyxJQUFJLENBQUMsTUFBTSxNQUFNO0FBQ2hCLE1BQUksSUFBSSxFQUFHLFFBQU87QUFDbEIsUUFBTSxPQUFPLFFBQVEsS0FBSyxLQUFLLENBQUM7QUFDaEMsU0FBTyxJQUFJLEtBQUssTUFBTSxLQUFLLElBQUksSUFBSSxJQUFJLElBQUksS0FBSztBQUNsRCxDQUFDLEVBQ0EsS0FBSyxFQUFFO0FBRVosU0FBUyxNQUFNLE1BQU0sT0FBTztBQUMxQixNQUFJLFNBQVM7QUFDYixhQUFXLFFBQVEsQ0FBQyxHQUFHLEtBQUssRUFBRSxLQUFLLENBQUMsR0FBRyxNQUFNLEVBQUUsT0FBTyxFQUFFLFFBQVEsRUFBRSxLQUFLLEVBQUUsRUFBRTtBQUN6RSxhQUFTLE9BQU8sTUFBTSxHQUFHLEtBQUssSUFBSSxJQUFJLEtBQUssT0FBTyxPQUFPLE1BQU0sS0FBSyxFQUFFO0FBQ3hFLFNBQU87QUFDVDtBQU1BLFNBQVMsVUFBVSxNQUFNLEVBQUUsT0FBTyxVQUFVLE9BQU8sR0FBRyxRQUFRO0FBQzVELE1BQUksQ0FBQyxPQUFRLFFBQU8sTUFBTSxNQUFNLEtBQUs7QUFDckMsUUFBTSxPQUFPLE1BQU0sTUFBTTtBQUFBLElBQ3ZCLEdBQUc7QUFBQSxJQUNILEdBQUcsY0FBYyxNQUFNO0FBQUEsSUFDdkIsR0FBRyxTQUFTLElBQUksQ0FBQyxFQUFFLE1BQU0sR0FBRyxPQUFPLEVBQUUsTUFBTSxJQUFJLE1BQU0sS0FBSyxNQUFNLE1BQU0sRUFBRSxFQUFFLFFBQVEsV0FBVyxFQUFFLEtBQUssSUFBSSxFQUFFO0FBQUEsRUFDNUcsQ0FBQztBQUNELFNBQU8sS0FBSyxNQUFNLElBQUksRUFBRSxJQUFJLFlBQVksRUFBRSxLQUFLLElBQUk7QUFDckQ7QUFHQSxTQUFTLFVBQVUsTUFBTTtBQUN2QixXQUFTLFNBQVMsUUFBUSxJQUFJLEdBQUcsV0FBVyxRQUFRLE1BQU0sR0FBRyxTQUFTLFFBQVEsTUFBTSxHQUFHO0FBQ3JGLFVBQU0sV0FBV0MsTUFBSyxRQUFRLGNBQWM7QUFDNUMsUUFBSUMsWUFBVyxRQUFRO0FBQ3JCLGFBQU8sRUFBRSxRQUFRLE9BQU8sS0FBSyxNQUFNQyxjQUFhLFVBQVUsTUFBTSxDQUFDLEVBQUUsS0FBSyxNQUFNLEdBQUcsRUFBRSxHQUFHLEVBQUUsRUFBRTtBQUFBLEVBQzlGO0FBQ0EsUUFBTSxJQUFJLFVBQVUsR0FBRyxJQUFJLDBCQUEwQjtBQUN2RDtBQU1BLElBQU0sV0FBVyxDQUFDLFNBQVMsZ0NBQWdDLEtBQUssSUFBSTtBQUc3RCxJQUFNLFNBQVMsQ0FBQyxTQUFTLEtBQUssR0FBRyxFQUFFLE1BQU07QUFPaEQsU0FBUyxjQUFjLEVBQUUsTUFBTSxNQUFNLEtBQUssR0FBRyxNQUFNLFFBQVE7QUFDekQsUUFBTSxDQUFDLE1BQU0sR0FBRyxJQUFJLElBQUk7QUFDeEIsUUFBTSxTQUFTLFNBQVMsWUFBWSxTQUFTLFNBQVMsVUFBVSxRQUFRLElBQUksSUFBSTtBQUNoRixNQUFJLFdBQVcsT0FBVyxPQUFNLElBQUksVUFBVSxHQUFHLElBQUksSUFBSSxJQUFJLE1BQU0sSUFBSSwyQ0FBMkM7QUFDbEgsUUFBTSxPQUFPLFFBQVEsUUFBUSxHQUFHLElBQUk7QUFDcEMsTUFBSUQsWUFBVyxHQUFHLElBQUksT0FBTyxFQUFHLFFBQU8sRUFBRSxNQUFNLEdBQUcsSUFBSSxTQUFTLE1BQU0sS0FBSztBQUMxRSxRQUFNLGFBQWEsR0FBR0QsTUFBSyxRQUFRLElBQUksSUFBSSxLQUFLLEdBQUcsRUFBRSxLQUFLLElBQUksV0FBVyxLQUFLLEdBQUcsQ0FBQyxDQUFDO0FBQ25GLE1BQUlDLFlBQVcsVUFBVSxFQUFHLFFBQU8sRUFBRSxNQUFNLFlBQVksTUFBTSxNQUFNO0FBQ25FLFFBQU0sSUFBSTtBQUFBLElBQ1IsR0FBRyxJQUFJLElBQUksSUFBSSx3QkFBd0IsS0FBSyxLQUFLLElBQUksQ0FBQyxjQUFjLElBQUksa0JBQWtCLElBQUksYUFBYSxVQUFVO0FBQUEsRUFDdkg7QUFDRjtBQWVPLFNBQVMsWUFBWSxNQUFNLE1BQU0sRUFBRSxTQUFTLE9BQU8sT0FBTyxNQUFNLElBQUksQ0FBQyxHQUFHO0FBQzdFLFFBQU0sU0FBUyxVQUFVLE1BQU0sSUFBSTtBQUNuQyxRQUFNLEVBQUUsUUFBUSxNQUFNLElBQUksVUFBVSxJQUFJO0FBQ3hDLFFBQU0sU0FBU0QsTUFBSyxRQUFRLEtBQUs7QUFDakMsUUFBTSxRQUFRLG9CQUFJLElBQUk7QUFDdEIsUUFBTSxlQUFlLG9CQUFJLElBQUk7QUFDN0IsUUFBTSxVQUFVLG9CQUFJLElBQUk7QUFDeEIsUUFBTSxPQUFPLG9CQUFJLElBQUksQ0FBQyxZQUFZLENBQUM7QUFDbkMsTUFBSSxVQUFVO0FBQ2QsYUFBVyxTQUFTLE9BQU8sU0FBUztBQUNsQyxRQUFJLE9BQU8sTUFBTSxJQUFJLEVBQUc7QUFDeEIsVUFBTSxFQUFFLE1BQU0sUUFBUSxLQUFLLElBQUksY0FBYyxPQUFPLE1BQU0sTUFBTTtBQUNoRSxVQUFNLFlBQVksS0FBS0csVUFBUyxRQUFRLElBQUksR0FBRyxNQUFNLEVBQUUsTUFBTSxHQUFHLEVBQUUsS0FBSyxHQUFHLENBQUMsR0FDeEUsUUFBUSxlQUFlLEtBQUssRUFDNUIsUUFBUSxTQUFTLEVBQUU7QUFDdEIsUUFBSSxDQUFDLFFBQVEsU0FBUyxNQUFNLElBQUksR0FBRztBQUNqQyxVQUFJLFFBQVEsSUFBSSxNQUFNLElBQUksRUFBRztBQUM3QixjQUFRLElBQUksTUFBTSxNQUFNLFNBQVMsUUFBUSxJQUFJLEVBQUU7QUFDL0MsaUJBQVcsWUFBWSxNQUFNLElBQUksT0FBTyxRQUFRLElBQUksTUFBTSxJQUFJLENBQUMsV0FBVyxLQUFLLFVBQVUsU0FBUyxDQUFDO0FBQ25HO0FBQUEsSUFDRjtBQUNBLFVBQU0sTUFBTSxPQUFPLFlBQVksR0FBRyxTQUFTLElBQUksTUFBTSxJQUFJO0FBQ3pELFFBQUksT0FBTyxNQUFNLElBQUksR0FBRztBQUN4QixRQUFJLFNBQVMsUUFBVztBQUN0QixZQUFNLElBQUksS0FBTSxPQUFPLFNBQVMsTUFBTSxJQUFJLEVBQUc7QUFDN0MsaUJBQVcsVUFBVSxPQUFPLE9BQU8sS0FBSyxNQUFNLElBQUksT0FBTyxJQUFJLElBQUksU0FBUyxLQUFLLFVBQVUsU0FBUyxDQUFDO0FBQUEsSUFDckc7QUFDQSxRQUFJLE1BQU0sU0FBUyxPQUFXLE1BQUssSUFBSSxPQUFPO0FBQzlDLFVBQU0sYUFDSixNQUFNLFNBQVMsU0FBWSxPQUFPLHlCQUF5QixLQUFLLFVBQVUsTUFBTSxJQUFJLENBQUMsS0FBSyxJQUFJO0FBQ2hHLGlCQUFhLElBQUksWUFBWSxVQUFVO0FBQUEsRUFDekM7QUFDQSxRQUFNLFFBQVEsR0FBRyxLQUFLLElBQUksS0FDdkIsTUFBTSxPQUFPLEVBQ2IsR0FBRyxFQUFFLEVBQ0wsUUFBUSxXQUFXLEVBQUUsRUFDckIsV0FBVyxLQUFLLEdBQUcsQ0FBQztBQUN2QixRQUFNLFFBQVEsVUFBVSxNQUFNLFFBQVEsVUFBVSxJQUFJO0FBQ3BELFFBQU0sWUFBWSxPQUFPLE1BQU0sUUFBUSxVQUFVLElBQUksRUFBRSxVQUFVLElBQUksT0FDbEUsUUFBUSxtQkFBbUIsTUFBTSxFQUNqQyxRQUFRLGlCQUFpQixDQUFDLFNBQVUsUUFBUSxJQUFJLElBQUksSUFBSSxNQUFNLFFBQVEsSUFBSSxJQUFJLENBQUMsT0FBTyxJQUFLO0FBRTlGLFFBQU0sT0FBTyxZQUFZLENBQUMsR0FBRyxJQUFJLEVBQUUsS0FBSyxFQUFFLEtBQUssSUFBSSxDQUFDLGdDQUFnQyxPQUFPLDZDQUE2QyxLQUFLLFVBQVUsS0FBSyxDQUFDLE9BQU8sUUFBUSxLQUFLLGFBQWEsT0FBTyxJQUFJLE1BQU0sQ0FBQyxHQUFHLGFBQWEsT0FBTyxDQUFDLEVBQUUsS0FBSyxJQUFJLENBQUMsTUFBTSxFQUFFO0FBQUE7QUFDNVAsUUFBTSxZQUFZLGNBQWMsTUFBTSxJQUFJO0FBQzFDLFFBQU0sV0FBVyxPQUFPLFFBQVEsT0FBTyxLQUFLLE1BQU0sSUFBSSxFQUFFLFNBQVMsQ0FBQyxDQUFDO0FBQ25FLFNBQU87QUFBQSxJQUNMLE1BQU0sWUFBWSxPQUFPLGtCQUFrQixTQUFTLElBQUk7QUFBQSxJQUN4RCxLQUFLLEVBQUUsU0FBUyxHQUFHLFNBQVMsQ0FBQyxLQUFLLE1BQU0sT0FBTyxFQUFFLEdBQUcsRUFBRSxDQUFDLEdBQUcsZ0JBQWdCLENBQUMsSUFBSSxHQUFHLE9BQU8sQ0FBQyxHQUFHLFNBQVM7QUFBQSxFQUN4RztBQUNGO0FBR08sSUFBTSxhQUFhLENBQUMsVUFBVSxDQUFDLE9BQU87QUFBQSxFQUMzQyxNQUFNO0FBQUEsRUFDTixNQUFNQyxRQUFPO0FBQ1gsSUFBQUEsT0FBTSxPQUFPLEVBQUUsUUFBUSxVQUFVLEdBQUcsQ0FBQyxFQUFFLEtBQUssTUFBTTtBQUNoRCxZQUFNLEVBQUUsTUFBTSxJQUFJLElBQUksWUFBWUYsY0FBYSxNQUFNLE1BQU0sR0FBRyxNQUFNLE9BQU87QUFDM0UsYUFBTztBQUFBLFFBQ0wsVUFBVSxHQUFHLElBQUkscURBQXFELE9BQU8sS0FBSyxLQUFLLFVBQVUsR0FBRyxDQUFDLEVBQUUsU0FBUyxRQUFRLENBQUM7QUFBQSxRQUN6SCxRQUFRO0FBQUEsUUFDUixZQUFZLFFBQVEsSUFBSTtBQUFBLE1BQzFCO0FBQUEsSUFDRixDQUFDO0FBQUEsRUFDSDtBQUNGOzs7QURsYndKLElBQU1HLDRDQUEyQztBQVV6TSxlQUFzQixXQUFXLFdBQW1CLE1BQWdDO0FBQ2xGLFFBQU0sRUFBRSxZQUFZLElBQUksTUFBTSxNQUFNO0FBQUEsSUFDbEMsT0FBTztBQUFBLE1BQ0wsVUFBVSxZQUFZLElBQUkscUJBQXFCLFNBQVM7QUFBQSxNQUN4RCxZQUFZQyxlQUFjLElBQUksSUFBSSxLQUFLRCx5Q0FBZSxDQUFDO0FBQUEsSUFDekQ7QUFBQSxJQUNBLFlBQVksQ0FBQyxlQUFlO0FBQUEsSUFDNUIsUUFBUTtBQUFBLElBQ1IsUUFBUTtBQUFBLElBQ1IsVUFBVTtBQUFBLElBQ1YsU0FBUyxDQUFDLFdBQVcsQ0FBQztBQUFBLElBQ3RCLE9BQU87QUFBQSxFQUNULENBQUM7QUFDRCxRQUFNLEVBQUUsTUFBTSxJQUFLLE1BQU0sT0FDdkIsK0JBQStCLE9BQU8sS0FBSyxZQUFZLENBQUMsRUFBRyxRQUFRLEVBQUUsU0FBUyxRQUFRLENBQUM7QUFFekYsU0FBTztBQUNUOzs7QUQzQmlLLElBQU1FLDRDQUEyQztBQWlCbE4sSUFBTSxTQUFTLENBQUMsVUFBa0IsT0FBTyxLQUFLLE1BQU0sUUFBUSxHQUFJLElBQUksR0FBSTtBQUN4RSxJQUFNLFFBQVEsQ0FBQyxVQUNiLE1BQU0sUUFBUSxLQUFLLElBQ2YsSUFBSSxNQUFNLElBQUksTUFBTSxFQUFFLEtBQUssSUFBSSxDQUFDLE1BQ2hDLE9BQU8sVUFBVSxXQUNmLE9BQU8sS0FBSyxJQUNaLE9BQU8sS0FBSztBQUVwQixJQUFPLHVCQUFRLGFBQWE7QUFBQSxFQUMxQixPQUFPLENBQUMsOENBQThDLDBCQUEwQjtBQUFBLEVBQ2hGLE1BQU0sT0FBaUM7QUFDckMsVUFBTSxVQUFXLE1BQU0sV0FBVywwQkFBMEIsaUJBQWlCO0FBSTdFLFdBQU8sT0FBTyxRQUFRLE9BQU8sRUFBRSxJQUFJLENBQUMsQ0FBQyxNQUFNLFVBQVUsT0FBTztBQUFBLE1BQzFEO0FBQUEsTUFDQSxNQUFNLE9BQU8sUUFBUSxVQUFVLEVBQzVCLElBQUksQ0FBQyxDQUFDLEtBQUssS0FBSyxNQUFNLEdBQUcsR0FBRyxLQUFLLE1BQU0sS0FBSyxDQUFDLEVBQUUsRUFDL0MsS0FBSyxJQUFJO0FBQUEsTUFDWixPQUFPQyxZQUFXQyxlQUFjLElBQUksSUFBSSxxQkFBcUIsSUFBSSxTQUFTQyx5Q0FBZSxDQUFDLENBQUMsSUFDdkYsWUFBWSxJQUFJLFVBQ2hCO0FBQUEsSUFDTixFQUFFO0FBQUEsRUFDSjtBQUNGLENBQUM7IiwKICAibmFtZXMiOiBbImV4aXN0c1N5bmMiLCAiZmlsZVVSTFRvUGF0aCIsICJmaWxlVVJMVG9QYXRoIiwgImV4aXN0c1N5bmMiLCAicmVhZEZpbGVTeW5jIiwgImpvaW4iLCAicmVsYXRpdmUiLCAidGV4dCIsICJpIiwgImRlcHRoIiwgImpvaW4iLCAiZXhpc3RzU3luYyIsICJyZWFkRmlsZVN5bmMiLCAicmVsYXRpdmUiLCAiYnVpbGQiLCAiX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCIsICJmaWxlVVJMVG9QYXRoIiwgIl9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwiLCAiZXhpc3RzU3luYyIsICJmaWxlVVJMVG9QYXRoIiwgIl9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwiXQp9Cg==
