// guide/command-line.data.ts
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

// guide/command-line.data.ts
var command_line_data_default = defineLoader({
  watch: ["../../../packages/cli/src/{help,render-flags}.ts", "../../../packages/renderer/src/render-options/*.ts"],
  load: async () => await readExport("../../../packages/cli/src/help.ts", "HELP")
});
export {
  command_line_data_default as default
};
//# sourceMappingURL=data:application/json;base64,ewogICJ2ZXJzaW9uIjogMywKICAic291cmNlcyI6IFsiZ3VpZGUvY29tbWFuZC1saW5lLmRhdGEudHMiLCAic3JjL3JlYWQtZXhwb3J0LnRzIiwgIi4uLy4uL3Rvb2xzL3BpcGVsaW5lL3dlc2wubWpzIiwgIi4uLy4uL3Rvb2xzL3BpcGVsaW5lL3dlc2wtY29uc3RhbnRzLm1qcyIsICIuLi8uLi90b29scy9waXBlbGluZS93ZXNsLXRva2Vucy5tanMiLCAiLi4vLi4vdG9vbHMvcGlwZWxpbmUvd2VzbC1uYW1lcy5tanMiXSwKICAic291cmNlc0NvbnRlbnQiOiBbImNvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9kaXJuYW1lID0gXCIvdG1wL3d0LW1lL2FwcHMvZG9jcy9ndWlkZVwiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS9hcHBzL2RvY3MvZ3VpZGUvY29tbWFuZC1saW5lLmRhdGEudHNcIjtjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfaW1wb3J0X21ldGFfdXJsID0gXCJmaWxlOi8vL3RtcC93dC1tZS9hcHBzL2RvY3MvZ3VpZGUvY29tbWFuZC1saW5lLmRhdGEudHNcIjsvLyBUaGUgbWFudWFsIHBhZ2Ugb3V0IG9mIHRoZSBjb21tYW5kJ3Mgb3duIHNvdXJjZXMuXG5pbXBvcnQgeyBkZWZpbmVMb2FkZXIgfSBmcm9tICd2aXRlcHJlc3MnO1xuaW1wb3J0IHsgcmVhZEV4cG9ydCB9IGZyb20gJy4uL3NyYy9yZWFkLWV4cG9ydCc7XG5cbmRlY2xhcmUgY29uc3QgZGF0YTogc3RyaW5nO1xuZXhwb3J0IHsgZGF0YSB9O1xuXG5leHBvcnQgZGVmYXVsdCBkZWZpbmVMb2FkZXIoe1xuICB3YXRjaDogWycuLi8uLi8uLi9wYWNrYWdlcy9jbGkvc3JjL3toZWxwLHJlbmRlci1mbGFnc30udHMnLCAnLi4vLi4vLi4vcGFja2FnZXMvcmVuZGVyZXIvc3JjL3JlbmRlci1vcHRpb25zLyoudHMnXSxcbiAgbG9hZDogYXN5bmMgKCk6IFByb21pc2U8c3RyaW5nPiA9PiAoYXdhaXQgcmVhZEV4cG9ydCgnLi4vLi4vLi4vcGFja2FnZXMvY2xpL3NyYy9oZWxwLnRzJywgJ0hFTFAnKSkgYXMgc3RyaW5nLFxufSk7XG4iLCAiY29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2Rpcm5hbWUgPSBcIi90bXAvd3QtbWUvYXBwcy9kb2NzL3NyY1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS9hcHBzL2RvY3Mvc3JjL3JlYWQtZXhwb3J0LnRzXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ltcG9ydF9tZXRhX3VybCA9IFwiZmlsZTovLy90bXAvd3QtbWUvYXBwcy9kb2NzL3NyYy9yZWFkLWV4cG9ydC50c1wiO2ltcG9ydCB7IGZpbGVVUkxUb1BhdGggfSBmcm9tICdub2RlOnVybCc7XG5pbXBvcnQgeyBidWlsZCB9IGZyb20gJ2VzYnVpbGQnO1xuaW1wb3J0IHsgd2VzbFNvdXJjZSB9IGZyb20gJy4uLy4uLy4uL3Rvb2xzL3BpcGVsaW5lL3dlc2wubWpzJztcblxuLyoqXG4gKiBFdmFsdWF0ZXMgb25lIGV4cG9ydCBvZiBhIG1vZHVsZSBvZiB0aGlzIHJlcG9zaXRvcnksIGZyb20gc291cmNlcywgYXQgYnVpbGQgdGltZTogcGFnZXMgdGhhdCB0ZWxsIGFib3V0IGNvZGUgcmVhZCBpdFxuICogaW5zdGVhZCBvZiBjb3B5aW5nIGl0LlxuICpcbiAqIEBwYXJhbSBzcGVjaWZpZXIgQSBwYWNrYWdlIGVudHJ5LCBvciBhIHBhdGggcmVsYXRpdmUgdG8gdGhpcyBmb2xkZXIuXG4gKi9cbmV4cG9ydCBhc3luYyBmdW5jdGlvbiByZWFkRXhwb3J0KHNwZWNpZmllcjogc3RyaW5nLCBuYW1lOiBzdHJpbmcpOiBQcm9taXNlPHVua25vd24+IHtcbiAgY29uc3QgeyBvdXRwdXRGaWxlcyB9ID0gYXdhaXQgYnVpbGQoe1xuICAgIHN0ZGluOiB7XG4gICAgICBjb250ZW50czogYGV4cG9ydCB7ICR7bmFtZX0gYXMgdmFsdWUgfSBmcm9tICcke3NwZWNpZmllcn0nO2AsXG4gICAgICByZXNvbHZlRGlyOiBmaWxlVVJMVG9QYXRoKG5ldyBVUkwoJy4nLCBpbXBvcnQubWV0YS51cmwpKSxcbiAgICB9LFxuICAgIGNvbmRpdGlvbnM6IFsnQGdsYW56L3NvdXJjZSddLFxuICAgIGJ1bmRsZTogdHJ1ZSxcbiAgICBmb3JtYXQ6ICdlc20nLFxuICAgIHBsYXRmb3JtOiAnbmV1dHJhbCcsXG4gICAgcGx1Z2luczogW3dlc2xTb3VyY2UoKV0sXG4gICAgd3JpdGU6IGZhbHNlLFxuICB9KTtcbiAgY29uc3QgeyB2YWx1ZSB9ID0gKGF3YWl0IGltcG9ydChcbiAgICBgZGF0YTp0ZXh0L2phdmFzY3JpcHQ7YmFzZTY0LCR7QnVmZmVyLmZyb20ob3V0cHV0RmlsZXNbMF0hLmNvbnRlbnRzKS50b1N0cmluZygnYmFzZTY0Jyl9YFxuICApKSBhcyB7IHZhbHVlOiB1bmtub3duIH07XG4gIHJldHVybiB2YWx1ZTtcbn1cbiIsICJjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZGlybmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZVwiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLm1qc1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwgPSBcImZpbGU6Ly8vdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wubWpzXCI7Ly8gU2hhZGVyIHNvdXJjZSBpbiBXRVNMIChodHRwczovL3dlc2wtbGFuZy5kZXYpLCB0dXJuZWQgaW50byB0aGUgbW9kdWxlcyB0aGF0IEBnbGFuei93Z3NsIGNvbXBvc2VzIGF0IHJ1biB0aW1lLlxuLy9cbi8vIGBpbXBvcnQgcGFja2FnZTo6YTo6Yjo6bmFtZTtgIGJlY29tZXMgYSBkZXBlbmRlbmN5LCBgQGlmKEZMQUcpIFx1MjAyNiBAZWxpZihGTEFHKSBcdTIwMjYgQGVsc2UgXHUyMDI2YCBvbiBkZWNsYXJhdGlvbnMsIG1lbWJlcnMsXG4vLyBwYXJhbWV0ZXJzLCBzdGF0ZW1lbnRzIGFuZCBpbXBvcnRzIGJlY29tZXMgZ2F0ZXMuIE5vdGhpbmcgZWxzZSBjaGFuZ2VzLCBhbmQgZXZlcnkgbGluZSBrZWVwcyBpdHMgbnVtYmVyOiBsaW5lIG4gb2YgYVxuLy8gbW9kdWxlJ3MgdGV4dCBpcyBsaW5lIG4gb2YgaXRzIGZpbGUuIE5vIHBhcnNlciBvZiBXRVNMIGlzIGluIHdoYXQgd2UgcHVibGlzaC5cbi8vXG4vLyBBIGZpbGUgb2YgY29uc3RhbnRzIGlzIFR5cGVTY3JpcHQncyB0b286IHNlZSB3ZXNsLWNvbnN0YW50cy5tanMuXG5pbXBvcnQgeyBleGlzdHNTeW5jLCByZWFkRmlsZVN5bmMgfSBmcm9tICdub2RlOmZzJztcbmltcG9ydCB7IGRpcm5hbWUsIGpvaW4sIHJlbGF0aXZlLCByZXNvbHZlLCBzZXAgfSBmcm9tICdub2RlOnBhdGgnO1xuaW1wb3J0IHsgZXhwb3J0ZWRDb25zdGFudHMsIHJlYWRDb25zdGFudHMgfSBmcm9tICcuL3dlc2wtY29uc3RhbnRzLm1qcyc7XG5pbXBvcnQgeyBzaG9ydGVuTG9jYWxzIH0gZnJvbSAnLi93ZXNsLW5hbWVzLm1qcyc7XG5pbXBvcnQgeyBXZXNsRXJyb3IsIHRva2VuaXplIH0gZnJvbSAnLi93ZXNsLXRva2Vucy5tanMnO1xuXG5leHBvcnQgeyBXZXNsRXJyb3IgfTtcblxuY29uc3QgQ0xPU0lORyA9IHsgJygnOiAnKScsICdbJzogJ10nLCAneyc6ICd9JywgJzwnOiAnPicgfTtcblxuLyoqXG4gKiBSZWFkcyBhIFdFU0wgZmlsZS5cbiAqXG4gKiBAcGFyYW0ge3N0cmluZ30gdGV4dFxuICogQHBhcmFtIHtzdHJpbmd9IGZpbGUgRm9yIG1lc3NhZ2VzLlxuICogQHJldHVybnMge3sgaW1wb3J0czogeyBwYXRoOiBzdHJpbmdbXSwgbmFtZTogc3RyaW5nLCBmbGFnOiBzdHJpbmcgfCB1bmRlZmluZWQsIGxpbmU6IG51bWJlciB9W10sIGVkaXRzOiB7IGZyb206XG4gKiAgIG51bWJlciwgdG86IG51bWJlciwgdGV4dDogc3RyaW5nIH1bXSwgY29tbWVudHM6IHsgZnJvbTogbnVtYmVyLCB0bzogbnVtYmVyIH1bXSwgdG9rZW5zOiB7IHRleHQ6IHN0cmluZywgZnJvbTogbnVtYmVyLFxuICogICB0bzogbnVtYmVyIH1bXSB9fSBgZWRpdHNgIHR1cm4gdGhlIHRleHQgaW50byBvbmUgd2l0aCBnYXRlcy4gYHBhdGhgIGlzIHRoZSBtb2R1bGUgb2YgYW4gaW1wb3J0ZWQgbmFtZS5cbiAqIEB0aHJvd3Mge1dlc2xFcnJvcn1cbiAqL1xuZXhwb3J0IGZ1bmN0aW9uIHBhcnNlV2VzbCh0ZXh0LCBmaWxlID0gJ21vZHVsZS53ZXNsJykge1xuICBjb25zdCBmYWlsID0gKGF0LCBtZXNzYWdlKSA9PiB7XG4gICAgdGhyb3cgbmV3IFdlc2xFcnJvcihgJHtmaWxlfToke3RleHQuc2xpY2UoMCwgYXQpLnNwbGl0KCdcXG4nKS5sZW5ndGh9OiAke21lc3NhZ2V9LmApO1xuICB9O1xuICBjb25zdCB7IHRva2VucywgY29tbWVudHMgfSA9IHRva2VuaXplKHRleHQsIGZhaWwpO1xuICBjb25zdCBpbXBvcnRzID0gW107XG4gIGNvbnN0IGVkaXRzID0gW107XG4gIGxldCBuZXh0ID0gMDtcbiAgY29uc3QgcGVlayA9ICgpID0+IHRva2Vuc1tuZXh0XT8udGV4dDtcbiAgY29uc3QgaGVyZSA9ICgpID0+IHRva2Vuc1tuZXh0XT8uZnJvbSA/PyB0ZXh0Lmxlbmd0aDtcbiAgY29uc3QgdGFrZSA9IChleHBlY3RlZCkgPT4ge1xuICAgIGNvbnN0IHRva2VuID0gdG9rZW5zW25leHRdO1xuICAgIGlmICghdG9rZW4pIHJldHVybiBmYWlsKHRleHQubGVuZ3RoLCBleHBlY3RlZCA/IGBcIiR7ZXhwZWN0ZWR9XCIgaXMgbWlzc2luZyBhdCB0aGUgZW5kYCA6ICd0aGUgZmlsZSBlbmRzIHRvbyBzb29uJyk7XG4gICAgaWYgKGV4cGVjdGVkICE9PSB1bmRlZmluZWQgJiYgdG9rZW4udGV4dCAhPT0gZXhwZWN0ZWQpXG4gICAgICBmYWlsKHRva2VuLmZyb20sIGBcIiR7dG9rZW4udGV4dH1cIiBzdGFuZHMgd2hlcmUgXCIke2V4cGVjdGVkfVwiIGlzIGV4cGVjdGVkYCk7XG4gICAgbmV4dCsrO1xuICAgIHJldHVybiB0b2tlbjtcbiAgfTtcbiAgY29uc3QgZW5kT2ZMYXN0ID0gKCkgPT4gdG9rZW5zW25leHQgLSAxXS50bztcblxuICAvKiogU2tpcHMgdGhlIGJyYWNrZXQgdGhhdCBpcyBuZXh0LCB3aXRoIGFsbCB0aGF0IGl0IGVuY2xvc2VzLiAqL1xuICBjb25zdCBza2lwQnJhY2tldCA9ICgpID0+IHtcbiAgICBjb25zdCBvcGVuID0gdGFrZSgpO1xuICAgIGZvciAoY29uc3QgY2xvc2UgPSBDTE9TSU5HW29wZW4udGV4dF07IHBlZWsoKSAhPT0gY2xvc2U7KSBza2lwVG9rZW4oKTtcbiAgICB0YWtlKCk7XG4gIH07XG4gIGNvbnN0IHNraXBUb2tlbiA9ICgpID0+IHtcbiAgICBpZiAocGVlaygpID09PSB1bmRlZmluZWQpIGZhaWwodGV4dC5sZW5ndGgsICd0aGUgZmlsZSBlbmRzIGluc2lkZSBvZiBhIGJyYWNrZXQnKTtcbiAgICBpZiAocGVlaygpID09PSAnQCcgJiYgL14oaWZ8ZWxpZnxlbHNlKSQvLnRlc3QodG9rZW5zW25leHQgKyAxXT8udGV4dCA/PyAnJykpXG4gICAgICBmYWlsKFxuICAgICAgICBoZXJlKCksXG4gICAgICAgIGBAJHt0b2tlbnNbbmV4dCArIDFdLnRleHR9IHN0YW5kcyB3aGVyZSBubyBkZWNsYXJhdGlvbiwgbWVtYmVyLCBwYXJhbWV0ZXIsIHN0YXRlbWVudCBvciBpbXBvcnQgYmVnaW5zYCxcbiAgICAgICk7XG4gICAgaWYgKHBlZWsoKSBpbiBDTE9TSU5HICYmIHBlZWsoKSAhPT0gJzwnKSBza2lwQnJhY2tldCgpO1xuICAgIGVsc2UgdGFrZSgpO1xuICB9O1xuICBjb25zdCBza2lwVG8gPSAoLi4uZW5kcykgPT4ge1xuICAgIHdoaWxlICghZW5kcy5pbmNsdWRlcyhwZWVrKCkpKSBza2lwVG9rZW4oKTtcbiAgfTtcblxuICAvKiogYChBICYmICFCKWAgYXMgdGhlIGNvbXBvc2VyIHJlYWRzIGl0LCBgQSYmIUJgLiAqL1xuICBjb25zdCBjb25kaXRpb24gPSAoKSA9PiB7XG4gICAgY29uc3QgZnJvbSA9IHRha2UoJygnKS5mcm9tO1xuICAgIGNvbnN0IHBhcnRzID0gW107XG4gICAgZG8ge1xuICAgICAgaWYgKHBhcnRzLmxlbmd0aCA+IDApIHRha2UoJyYmJyk7XG4gICAgICBsZXQgbmVnYXRlZCA9IGZhbHNlO1xuICAgICAgd2hpbGUgKHBlZWsoKSA9PT0gJyEnKSB7XG4gICAgICAgIHRha2UoKTtcbiAgICAgICAgbmVnYXRlZCA9ICFuZWdhdGVkO1xuICAgICAgfVxuICAgICAgY29uc3QgZmxhZyA9IHRha2UoKTtcbiAgICAgIGlmICghL15bQS1aYS16X11cXHcqJC8udGVzdChmbGFnLnRleHQpKVxuICAgICAgICBmYWlsKFxuICAgICAgICAgIGZsYWcuZnJvbSxcbiAgICAgICAgICAnYSBjb25kaXRpb24gaXMgYSBmbGFnLCAhZmxhZywgb3Igc2V2ZXJhbCBvZiB0aGVtIHdpdGggJiYgYmV0d2VlbjsgZm9yIHx8IHVzZSBhIGZsYWcgdGhhdCBzdGFuZHMgZm9yIGJvdGgnLFxuICAgICAgICApO1xuICAgICAgcGFydHMucHVzaChgJHtuZWdhdGVkID8gJyEnIDogJyd9JHtmbGFnLnRleHR9YCk7XG4gICAgfSB3aGlsZSAocGVlaygpID09PSAnJiYnKTtcbiAgICBpZiAocGVlaygpICE9PSAnKScpXG4gICAgICBmYWlsKFxuICAgICAgICBmcm9tLFxuICAgICAgICAnYSBjb25kaXRpb24gaXMgYSBmbGFnLCAhZmxhZywgb3Igc2V2ZXJhbCBvZiB0aGVtIHdpdGggJiYgYmV0d2VlbjsgZm9yIHx8IHVzZSBhIGZsYWcgdGhhdCBzdGFuZHMgZm9yIGJvdGgnLFxuICAgICAgKTtcbiAgICB0YWtlKCcpJyk7XG4gICAgcmV0dXJuIHBhcnRzLmpvaW4oJyYmJyk7XG4gIH07XG5cbiAgLyoqIFRoZSBhdHRyaWJ1dGVzIGJlZm9yZSBhbiBlbGVtZW50OyBhdCBtb3N0IG9uZSBvZiB0aGVtIGlzIGEgZ2F0ZS4gKi9cbiAgY29uc3QgYXR0cmlidXRlcyA9ICgpID0+IHtcbiAgICBsZXQgZ2F0ZTtcbiAgICB3aGlsZSAocGVlaygpID09PSAnQCcpIHtcbiAgICAgIGNvbnN0IHsgZnJvbSB9ID0gdGFrZSgnQCcpO1xuICAgICAgY29uc3QgbmFtZSA9IHRha2UoKTtcbiAgICAgIGlmICgvXihpZnxlbGlmfGVsc2UpJC8udGVzdChuYW1lLnRleHQpKSB7XG4gICAgICAgIGlmIChnYXRlKSBmYWlsKGZyb20sICdhbiBlbGVtZW50IGhhcyB0d28gY29uZGl0aW9uczogam9pbiB0aGVtIGJ5ICYmJyk7XG4gICAgICAgIGdhdGUgPSB7IGtpbmQ6IG5hbWUudGV4dCwgZnJvbSwgY29uZGl0aW9uOiBuYW1lLnRleHQgPT09ICdlbHNlJyA/IHVuZGVmaW5lZCA6IGNvbmRpdGlvbigpLCB0bzogMCB9O1xuICAgICAgICBnYXRlLnRvID0gZW5kT2ZMYXN0KCk7XG4gICAgICB9IGVsc2UgaWYgKHBlZWsoKSA9PT0gJygnKSBza2lwQnJhY2tldCgpO1xuICAgIH1cbiAgICByZXR1cm4gZ2F0ZTtcbiAgfTtcblxuICBjb25zdCBpbXBvcnRUcmVlID0gKHBhdGgpID0+IHtcbiAgICBjb25zdCBmb3VuZCA9IFtdO1xuICAgIGNvbnN0IGJyYW5jaCA9IChiZWZvcmUpID0+IHtcbiAgICAgIGlmIChwZWVrKCkgPT09ICd7Jykge1xuICAgICAgICB0YWtlKCd7Jyk7XG4gICAgICAgIHdoaWxlIChwZWVrKCkgIT09ICd9Jykge1xuICAgICAgICAgIGJyYW5jaChiZWZvcmUpO1xuICAgICAgICAgIGlmIChwZWVrKCkgIT09ICd9JykgdGFrZSgnLCcpO1xuICAgICAgICB9XG4gICAgICAgIHRha2UoJ30nKTtcbiAgICAgICAgcmV0dXJuO1xuICAgICAgfVxuICAgICAgY29uc3QgbmFtZSA9IHRha2UoKTtcbiAgICAgIGlmICghL15bQS1aYS16X11cXHcqJC8udGVzdChuYW1lLnRleHQpKSBmYWlsKG5hbWUuZnJvbSwgYFwiJHtuYW1lLnRleHR9XCIgaXMgbm8gbmFtZSB0byBpbXBvcnRgKTtcbiAgICAgIGlmIChwZWVrKCkgPT09ICc6OicpIHtcbiAgICAgICAgdGFrZSgnOjonKTtcbiAgICAgICAgYnJhbmNoKFsuLi5iZWZvcmUsIG5hbWUudGV4dF0pO1xuICAgICAgfSBlbHNlIGlmIChwZWVrKCkgPT09ICdhcycpIGZhaWwoaGVyZSgpLCAnaW1wb3J0cyBjYW5ub3QgYmUgcmVuYW1lZDogbmFtZXMgYXJlIHVuaXF1ZSBpbiBhbGwgb2YgdGhlIHByb2plY3QnKTtcbiAgICAgIGVsc2UgZm91bmQucHVzaCh7IHBhdGg6IGJlZm9yZSwgbmFtZTogbmFtZS50ZXh0LCBhdDogbmFtZS5mcm9tIH0pO1xuICAgIH07XG4gICAgYnJhbmNoKHBhdGgpO1xuICAgIHJldHVybiBmb3VuZDtcbiAgfTtcblxuICBjb25zdCBpbXBvcnRTdGF0ZW1lbnQgPSAoZnJvbSwgZ2F0ZSkgPT4ge1xuICAgIGlmIChnYXRlICYmIChnYXRlLmtpbmQgIT09ICdpZicgfHwgZ2F0ZS5jb25kaXRpb24uaW5jbHVkZXMoJyYnKSkpXG4gICAgICBmYWlsKGZyb20sICdhbiBpbXBvcnQgaXMgZ2F0ZWQgYnkgQGlmKEZMQUcpIG9yIEBpZighRkxBRyknKTtcbiAgICB0YWtlKCdpbXBvcnQnKTtcbiAgICBmb3IgKGNvbnN0IHsgcGF0aCwgbmFtZSwgYXQgfSBvZiBpbXBvcnRUcmVlKFtdKSkge1xuICAgICAgaWYgKHBhdGgubGVuZ3RoID09PSAwKSBmYWlsKGF0LCBgXCJpbXBvcnQgJHtuYW1lfVwiIG5hbWVzIG5vIG1vZHVsZWApO1xuICAgICAgaW1wb3J0cy5wdXNoKHsgcGF0aCwgbmFtZSwgZmxhZzogZ2F0ZT8uY29uZGl0aW9uLCBsaW5lOiB0ZXh0LnNsaWNlKDAsIGF0KS5zcGxpdCgnXFxuJykubGVuZ3RoIH0pO1xuICAgIH1cbiAgICB0YWtlKCc7Jyk7XG4gICAgLy8gTGluZSBicmVha3Mgc3RheS5cbiAgICBlZGl0cy5wdXNoKHsgZnJvbSwgdG86IGVuZE9mTGFzdCgpLCB0ZXh0OiB0ZXh0LnNsaWNlKGZyb20sIGVuZE9mTGFzdCgpKS5yZXBsYWNlKC9bXlxcbl0rL2csICcnKSB9KTtcbiAgfTtcblxuICBjb25zdCBibG9jayA9ICgpID0+IHtcbiAgICB0YWtlKCd7Jyk7XG4gICAgc2VxdWVuY2Uoc3RhdGVtZW50LCAnfScpO1xuICAgIHRha2UoJ30nKTtcbiAgfTtcblxuICBjb25zdCBkZWNsYXJhdGlvbiA9ICgpID0+IHtcbiAgICBpZiAocGVlaygpID09PSAnZm4nKSB7XG4gICAgICB0YWtlKCk7XG4gICAgICB0YWtlKCk7XG4gICAgICB0YWtlKCcoJyk7XG4gICAgICBzZXF1ZW5jZShsaXN0ZWQoJyknKSwgJyknKTtcbiAgICAgIHRha2UoJyknKTtcbiAgICAgIHNraXBUbygneycpO1xuICAgICAgYmxvY2soKTtcbiAgICB9IGVsc2UgaWYgKHBlZWsoKSA9PT0gJ3N0cnVjdCcpIHtcbiAgICAgIHRha2UoKTtcbiAgICAgIHRha2UoKTtcbiAgICAgIHRha2UoJ3snKTtcbiAgICAgIHNlcXVlbmNlKGxpc3RlZCgnfScpLCAnfScpO1xuICAgICAgdGFrZSgnfScpO1xuICAgICAgaWYgKHBlZWsoKSA9PT0gJzsnKSB0YWtlKCk7XG4gICAgfSBlbHNlIHtcbiAgICAgIGlmIChwZWVrKCkgIT09ICc7Jykgc2tpcFRvKCc7Jyk7XG4gICAgICB0YWtlKCc7Jyk7XG4gICAgfVxuICB9O1xuXG4gIC8qKiBBIG1lbWJlciBvZiBhIHN0cnVjdCBvciBhIHBhcmFtZXRlci4gKi9cbiAgY29uc3QgbGlzdGVkID0gKGNsb3NlKSA9PiAoKSA9PiB7XG4gICAgbGV0IGRlcHRoID0gMDtcbiAgICB3aGlsZSAoZGVwdGggPiAwIHx8IChwZWVrKCkgIT09ICcsJyAmJiBwZWVrKCkgIT09IGNsb3NlKSkge1xuICAgICAgaWYgKHBlZWsoKSA9PT0gJzwnKSBkZXB0aCsrO1xuICAgICAgaWYgKHBlZWsoKSA9PT0gJz4nKSBkZXB0aC0tO1xuICAgICAgc2tpcFRva2VuKCk7XG4gICAgfVxuICAgIGlmIChwZWVrKCkgPT09ICcsJykgdGFrZSgpO1xuICB9O1xuXG4gIGNvbnN0IGNsYXVzZSA9ICgpID0+IHtcbiAgICBpZiAocGVlaygpICE9PSAnY2FzZScgJiYgcGVlaygpICE9PSAnZGVmYXVsdCcpIGZhaWwoaGVyZSgpLCBgXCIke3BlZWsoKX1cIiBzdGFuZHMgd2hlcmUgYSBjYXNlIGlzIGV4cGVjdGVkYCk7XG4gICAgc2tpcFRvKCd7Jyk7XG4gICAgYmxvY2soKTtcbiAgfTtcblxuICBjb25zdCBzdGF0ZW1lbnQgPSAoKSA9PiB7XG4gICAgc3dpdGNoIChwZWVrKCkpIHtcbiAgICAgIGNhc2UgJ3snOlxuICAgICAgICByZXR1cm4gYmxvY2soKTtcbiAgICAgIGNhc2UgJ2lmJzpcbiAgICAgIGNhc2UgJ2Zvcic6XG4gICAgICBjYXNlICd3aGlsZSc6XG4gICAgICAgIHRha2UoKTtcbiAgICAgICAgc2tpcFRvKCd7Jyk7XG4gICAgICAgIGJsb2NrKCk7XG4gICAgICAgIHdoaWxlIChwZWVrKCkgPT09ICdlbHNlJykge1xuICAgICAgICAgIHRha2UoKTtcbiAgICAgICAgICBza2lwVG8oJ3snKTtcbiAgICAgICAgICBibG9jaygpO1xuICAgICAgICB9XG4gICAgICAgIHJldHVybiB1bmRlZmluZWQ7XG4gICAgICBjYXNlICdsb29wJzpcbiAgICAgIGNhc2UgJ2NvbnRpbnVpbmcnOlxuICAgICAgICB0YWtlKCk7XG4gICAgICAgIHNraXBUbygneycpO1xuICAgICAgICByZXR1cm4gYmxvY2soKTtcbiAgICAgIGNhc2UgJ3N3aXRjaCc6XG4gICAgICAgIHRha2UoKTtcbiAgICAgICAgc2tpcFRvKCd7Jyk7XG4gICAgICAgIHRha2UoJ3snKTtcbiAgICAgICAgc2VxdWVuY2UoY2xhdXNlLCAnfScpO1xuICAgICAgICB0YWtlKCd9Jyk7XG4gICAgICAgIHJldHVybiB1bmRlZmluZWQ7XG4gICAgICBkZWZhdWx0OlxuICAgICAgICBza2lwVG8oJzsnLCAnfScpO1xuICAgICAgICB0YWtlKCc7Jyk7XG4gICAgICAgIHJldHVybiB1bmRlZmluZWQ7XG4gICAgfVxuICB9O1xuXG4gIC8qKiBFbGVtZW50cyB1cCB0byBhIGNsb3NpbmcgYnJhY2tldCwgb3IgdG8gdGhlIGVuZCBvZiB0aGUgZmlsZSwgd2l0aCB0aGVpciBjaGFpbnMgb2YgY29uZGl0aW9ucy4gKi9cbiAgY29uc3Qgc2VxdWVuY2UgPSAoZWxlbWVudCwgY2xvc2UpID0+IHtcbiAgICAvLyBIb3cgbWFueSBnYXRlcyBvZiB0aGUgY2hhaW4gYXJlIG9wZW4sIGFuZCB0aGUgY29uZGl0aW9uIG9mIGEgY2hhaW4gdGhhdCBpcyBvbmUgQGlmIGFsb25lLlxuICAgIGxldCBvcGVuID0gMDtcbiAgICBsZXQgZW5kID0gMDtcbiAgICBsZXQgYWxvbmU7XG4gICAgY29uc3QgY2xvc2VDaGFpbiA9ICgpID0+IHtcbiAgICAgIGlmIChvcGVuID4gMClcbiAgICAgICAgZWRpdHMucHVzaCh7IGZyb206IGVuZCwgdG86IGVuZCwgdGV4dDogYCR7Jy8vI2VuZGlmJy5yZXBlYXQob3Blbil9JHsvXFx3Ly50ZXN0KHRleHRbZW5kXSA/PyAnJykgPyAnICcgOiAnJ31gIH0pO1xuICAgICAgb3BlbiA9IDA7XG4gICAgICBhbG9uZSA9IHVuZGVmaW5lZDtcbiAgICB9O1xuICAgIHdoaWxlIChwZWVrKCkgIT09IGNsb3NlKSB7XG4gICAgICBpZiAocGVlaygpID09PSB1bmRlZmluZWQpIGZhaWwodGV4dC5sZW5ndGgsIGBcIiR7Y2xvc2V9XCIgaXMgbWlzc2luZyBhdCB0aGUgZW5kYCk7XG4gICAgICBjb25zdCBmcm9tID0gaGVyZSgpO1xuICAgICAgY29uc3QgZ2F0ZSA9IGF0dHJpYnV0ZXMoKTtcbiAgICAgIC8vIE5laWdoYm91cnMgb2Ygb25lIGNvbmRpdGlvbiBzaGFyZSBhIGdhdGUuXG4gICAgICBjb25zdCBzaGFyZWQgPSBnYXRlPy5raW5kID09PSAnaWYnICYmIGdhdGUuY29uZGl0aW9uID09PSBhbG9uZSAmJiBwZWVrKCkgIT09ICdpbXBvcnQnO1xuICAgICAgaWYgKCghZ2F0ZSB8fCBnYXRlLmtpbmQgPT09ICdpZicpICYmICFzaGFyZWQpIGNsb3NlQ2hhaW4oKTtcbiAgICAgIGlmIChwZWVrKCkgPT09ICdpbXBvcnQnICYmIGNsb3NlID09PSB1bmRlZmluZWQpIHtcbiAgICAgICAgaW1wb3J0U3RhdGVtZW50KGZyb20sIGdhdGUpO1xuICAgICAgICBjb250aW51ZTtcbiAgICAgIH1cbiAgICAgIGlmIChnYXRlKSB7XG4gICAgICAgIGlmIChnYXRlLmtpbmQgIT09ICdpZicgJiYgb3BlbiA9PT0gMCkgZmFpbChnYXRlLmZyb20sIGBAJHtnYXRlLmtpbmR9IHdpdGhvdXQgQGlmIGJlZm9yZSBpdGApO1xuICAgICAgICBjb25zdCBzdGFydCA9IGdhdGUua2luZCA9PT0gJ2lmJyA/ICcnIDogJy8vI2Vsc2UnO1xuICAgICAgICBjb25zdCBnYXAgPSAvXFxzLy50ZXN0KHRleHRbZ2F0ZS50b10gPz8gJyAnKSA/ICcnIDogJyAnO1xuICAgICAgICBjb25zdCBtYXJrcyA9IHNoYXJlZCA/ICcnIDogYCR7c3RhcnR9JHtnYXRlLmNvbmRpdGlvbiA9PT0gdW5kZWZpbmVkID8gJycgOiBgLy8jaWYgJHtnYXRlLmNvbmRpdGlvbn1gfWA7XG4gICAgICAgIGVkaXRzLnB1c2goeyBmcm9tOiBnYXRlLmZyb20sIHRvOiBnYXRlLnRvLCB0ZXh0OiBgJHttYXJrc30ke2dhcH1gIH0pO1xuICAgICAgICBpZiAoZ2F0ZS5jb25kaXRpb24gIT09IHVuZGVmaW5lZCAmJiAhc2hhcmVkKSBvcGVuKys7XG4gICAgICAgIGFsb25lID0gZ2F0ZS5raW5kID09PSAnaWYnID8gZ2F0ZS5jb25kaXRpb24gOiB1bmRlZmluZWQ7XG4gICAgICB9XG4gICAgICBlbGVtZW50KCk7XG4gICAgICBlbmQgPSBlbmRPZkxhc3QoKTtcbiAgICAgIGlmIChnYXRlPy5raW5kID09PSAnZWxzZScpIGNsb3NlQ2hhaW4oKTtcbiAgICB9XG4gICAgY2xvc2VDaGFpbigpO1xuICB9O1xuXG4gIHNlcXVlbmNlKGRlY2xhcmF0aW9uLCB1bmRlZmluZWQpO1xuICBmb3IgKGNvbnN0IHsgZnJvbSwgdG8gfSBvZiBjb21tZW50cylcbiAgICBpZiAodGV4dC5zbGljZShmcm9tLCB0bykuaW5jbHVkZXMoJy8vIycpKSBmYWlsKGZyb20sICdhIGNvbW1lbnQgbXVzdCBub3QgaG9sZCBcIi8vI1wiLCB3aGljaCBtYXJrcyBnYXRlcycpO1xuICByZXR1cm4geyBpbXBvcnRzLCBlZGl0cywgY29tbWVudHMsIHRva2VucyB9O1xufVxuXG5jb25zdCBPUEVSQVRPUiA9IC9bLSsqLyU9PD4hJnxefl0vO1xuXG4vKipcbiAqIEEgbGluZSBvZiBXR1NMIHdpdGhvdXQgdGhlIHNwYWNlcyB0aGF0IHNlcGFyYXRlIG5vdGhpbmc6IHRob3NlIGJlc2lkZSBwdW5jdHVhdGlvbi4gQmV0d2VlbiB0d28gb3BlcmF0b3JzIHRoZXkgc3RheSxcbiAqIGZvciBgYSAtIC1iYCBhbmQgYGFycmF5PGYzMj4gPSB4YCBtZWFuIHNvbWV0aGluZyBlbHNlIHdpdGhvdXQgdGhlbS4gTGluZXMgd2l0aCBjb21tZW50cyBzdGF5IGFzIHRoZXkgYXJlLlxuICovXG5leHBvcnQgZnVuY3Rpb24gY2xvc2VVcChsaW5lKSB7XG4gIGlmIChsaW5lLmluY2x1ZGVzKCcvLycpKSByZXR1cm4gbGluZTtcbiAgY29uc3QgY2xvc2VkID0gbGluZS5yZXBsYWNlKC8oPzw9KFxcUykpICsoPz0oXFxTKSkvZywgKHNwYWNlcywgYmVmb3JlLCBhZnRlcikgPT4ge1xuICAgIGNvbnN0IHNlcGFyYXRlcyA9IC9cXHcvLnRlc3QoYmVmb3JlKSAmJiAvXFx3Ly50ZXN0KGFmdGVyKTtcbiAgICByZXR1cm4gc2VwYXJhdGVzIHx8IChPUEVSQVRPUi50ZXN0KGJlZm9yZSkgJiYgT1BFUkFUT1IudGVzdChhZnRlcikpID8gc3BhY2VzIDogJyc7XG4gIH0pO1xuICAvLyAxLjAgaXMgMS4gYW5kIDAuNSBpcyAuNTsgd2hhdCBhIHN1YnN0aXR1dGlvbiBtYXkgZ28gb24gd2l0aCBzdGF5cy5cbiAgcmV0dXJuIGNsb3NlZC5yZXBsYWNlKC8oPzw9XFxkXFwuKTAoPz1bXlxcdy5dKS9nLCAnJykucmVwbGFjZSgvKD88IVtcXHcuXSkwKD89XFwuXFxkKS9nLCAnJyk7XG59XG5cbi8qKiBBIGxpbmUgd2l0aCBnYXRlcywgd2l0aG91dCB0aGUgc3BhY2VzIHRoYXQgc2VwYXJhdGUgbm90aGluZy4gKi9cbmNvbnN0IGNsb3NlVXBHYXRlZCA9IChsaW5lKSA9PlxuICBsaW5lXG4gICAgLnNwbGl0KC8oXFwvXFwvIyg/OmlmIFtcXHchJl0rfGVsc2V8ZW5kaWYpKS8pXG4gICAgLm1hcCgocGFydCwgaSkgPT4ge1xuICAgICAgaWYgKGkgJSAyKSByZXR1cm4gcGFydDtcbiAgICAgIGNvbnN0IHNodXQgPSBjbG9zZVVwKHBhcnQudHJpbSgpKTtcbiAgICAgIHJldHVybiBpID4gMCAmJiAvXlxcdy8udGVzdChzaHV0KSA/IGAgJHtzaHV0fWAgOiBzaHV0O1xuICAgIH0pXG4gICAgLmpvaW4oJycpO1xuXG5mdW5jdGlvbiBhcHBseSh0ZXh0LCBlZGl0cykge1xuICBsZXQgcmVzdWx0ID0gdGV4dDtcbiAgZm9yIChjb25zdCBlZGl0IG9mIFsuLi5lZGl0c10uc29ydCgoYSwgYikgPT4gYi5mcm9tIC0gYS5mcm9tIHx8IGIudG8gLSBhLnRvKSlcbiAgICByZXN1bHQgPSByZXN1bHQuc2xpY2UoMCwgZWRpdC5mcm9tKSArIGVkaXQudGV4dCArIHJlc3VsdC5zbGljZShlZGl0LnRvKTtcbiAgcmV0dXJuIHJlc3VsdDtcbn1cblxuLyoqXG4gKiBUaGUgdGV4dCB3aXRoIGdhdGVzIGZvciB0aGUgY29tcG9zZXIsIGxpbmUgYnkgbGluZSB0aGF0IG9mIHRoZSBmaWxlLiBAcGFyYW0ge2Jvb2xlYW59IHNocmluayBXaXRob3V0IGNvbW1lbnRzIGFuZFxuICogc3BhY2VzIHRoYXQgc2VwYXJhdGUgbm90aGluZywgYW5kIHdpdGggc2hvcnQgbmFtZXMgaW4gZnVuY3Rpb25zLlxuICovXG5mdW5jdGlvbiBnYXRlZFRleHQodGV4dCwgeyBlZGl0cywgY29tbWVudHMsIHRva2VucyB9LCBzaHJpbmspIHtcbiAgaWYgKCFzaHJpbmspIHJldHVybiBhcHBseSh0ZXh0LCBlZGl0cyk7XG4gIGNvbnN0IGJhcmUgPSBhcHBseSh0ZXh0LCBbXG4gICAgLi4uZWRpdHMsXG4gICAgLi4uc2hvcnRlbkxvY2Fscyh0b2tlbnMpLFxuICAgIC4uLmNvbW1lbnRzLm1hcCgoeyBmcm9tLCB0byB9KSA9PiAoeyBmcm9tLCB0bywgdGV4dDogdGV4dC5zbGljZShmcm9tLCB0bykucmVwbGFjZSgvW15cXG5dKy9nLCAnJykgfHwgJyAnIH0pKSxcbiAgXSk7XG4gIHJldHVybiBiYXJlLnNwbGl0KCdcXG4nKS5tYXAoY2xvc2VVcEdhdGVkKS5qb2luKCdcXG4nKTtcbn1cblxuLyoqIFRoZSBuZWFyZXN0IGZvbGRlciB3aXRoIGEgcGFja2FnZS5qc29uLCBhbmQgaXRzIG5hbWUgd2l0aG91dCB0aGUgc2NvcGUuICovXG5mdW5jdGlvbiBwYWNrYWdlT2YoZmlsZSkge1xuICBmb3IgKGxldCBmb2xkZXIgPSBkaXJuYW1lKGZpbGUpOyBmb2xkZXIgIT09IGRpcm5hbWUoZm9sZGVyKTsgZm9sZGVyID0gZGlybmFtZShmb2xkZXIpKSB7XG4gICAgY29uc3QgbWFuaWZlc3QgPSBqb2luKGZvbGRlciwgJ3BhY2thZ2UuanNvbicpO1xuICAgIGlmIChleGlzdHNTeW5jKG1hbmlmZXN0KSlcbiAgICAgIHJldHVybiB7IGZvbGRlciwgc2hvcnQ6IEpTT04ucGFyc2UocmVhZEZpbGVTeW5jKG1hbmlmZXN0LCAndXRmOCcpKS5uYW1lLnNwbGl0KCcvJykuYXQoLTEpIH07XG4gIH1cbiAgdGhyb3cgbmV3IFdlc2xFcnJvcihgJHtmaWxlfTogaXQgbGllcyBpbiBubyBwYWNrYWdlLmApO1xufVxuXG4vKipcbiAqIFdoZXRoZXIgYW4gaW1wb3J0ZWQgbmFtZSBpcyBhIG51bWJlcjogdGhvc2Ugb2YgVHlwZVNjcmlwdCBhcmUgaW4gY2FwaXRhbHMuIEl0IHN0YW5kcyBpbiB0aGUgdGV4dCBhcyBhIGxpdGVyYWwgdTMyLCBzb1xuICogdGhhdCBob3N0cyBhbmQgc2hhZGVycyBzaGFyZSBvbmUgdGFibGUuXG4gKi9cbmNvbnN0IGlzTnVtYmVyID0gKG5hbWUpID0+IC9eW0EtWl1bQS1aXFxkXSooPzpfW0EtWlxcZF0rKSokLy50ZXN0KG5hbWUpO1xuXG4vKiogRmlsZXMgdGhhdCBvbmx5IGRlY2xhcmUgd2hhdCB0aGUgaG9zdCBvZiBhIGxpYnJhcnkgc3VwcGxpZXMsIHNvIHRoYXQgZWRpdG9ycyBrbm93IGl0LiAqL1xuZXhwb3J0IGNvbnN0IGlzSG9zdCA9IChwYXRoKSA9PiBwYXRoLmF0KC0xKSA9PT0gJ2hvc3QnO1xuXG4vKipcbiAqIFRoZSBmaWxlIHRoYXQgYW4gaW1wb3J0ZWQgbW9kdWxlIGlzIGluLlxuICogQHJldHVybnMge3sgZmlsZTogc3RyaW5nLCB3ZXNsOiBib29sZWFuIH19IGB3ZXNsYCBmYWxzZTogVHlwZVNjcmlwdCB0aGF0IGV4cG9ydHMgYSBtb2R1bGUgYnkgdGhlIGltcG9ydGVkIG5hbWUuXG4gKiBAdGhyb3dzIHtXZXNsRXJyb3J9XG4gKi9cbmZ1bmN0aW9uIHJlc29sdmVNb2R1bGUoeyBwYXRoLCBuYW1lLCBsaW5lIH0sIGZpbGUsIHNvdXJjZSkge1xuICBjb25zdCBbcm9vdCwgLi4ucmVzdF0gPSBwYXRoO1xuICBjb25zdCBmb2xkZXIgPSByb290ID09PSAncGFja2FnZScgPyBzb3VyY2UgOiByb290ID09PSAnc3VwZXInID8gZGlybmFtZShmaWxlKSA6IHVuZGVmaW5lZDtcbiAgaWYgKGZvbGRlciA9PT0gdW5kZWZpbmVkKSB0aHJvdyBuZXcgV2VzbEVycm9yKGAke2ZpbGV9OiR7bGluZX06IFwiJHtyb290fVwiIGlzIG5vIHJvb3Qgb2YgYSBwYXRoOiBwYWNrYWdlIG9yIHN1cGVyLmApO1xuICBjb25zdCBiYXNlID0gcmVzb2x2ZShmb2xkZXIsIC4uLnJlc3QpO1xuICBpZiAoZXhpc3RzU3luYyhgJHtiYXNlfS53ZXNsYCkpIHJldHVybiB7IGZpbGU6IGAke2Jhc2V9Lndlc2xgLCB3ZXNsOiB0cnVlIH07XG4gIGNvbnN0IHR5cGVzY3JpcHQgPSBgJHtqb2luKGRpcm5hbWUoYmFzZSksIChyZXN0LmF0KC0xKSA/PyAnJykucmVwbGFjZUFsbCgnXycsICctJykpfS50c2A7XG4gIGlmIChleGlzdHNTeW5jKHR5cGVzY3JpcHQpKSByZXR1cm4geyBmaWxlOiB0eXBlc2NyaXB0LCB3ZXNsOiBmYWxzZSB9O1xuICB0aHJvdyBuZXcgV2VzbEVycm9yKFxuICAgIGAke2ZpbGV9OiR7bGluZX06IHRoZXJlIGlzIG5vIG1vZHVsZSAke3BhdGguam9pbignOjonKX0gdG8gaW1wb3J0ICR7bmFtZX0gZnJvbTogbmVpdGhlciAke2Jhc2V9Lndlc2wgbm9yICR7dHlwZXNjcmlwdH0uYCxcbiAgKTtcbn1cblxuLyoqXG4gKiBBIFdFU0wgZmlsZSBhcyBhIEphdmFTY3JpcHQgbW9kdWxlIHdob3NlIGRlZmF1bHQgZXhwb3J0IGlzIGl0cyBgV2dzbE1vZHVsZWAuIEl0cyBuYW1lIGlzIGA8cGFja2FnZT4vPGZpbGU+YCwgd2l0aFxuICogaHlwaGVucyBmb3IgdW5kZXJzY29yZXMuIFRoZSBjb25zdGFudHMgb2YgYSBmaWxlIHRoYXQgaG9sZHMgbm90aGluZyBlbHNlIGFyZSBleHBvcnRlZCBieSB0aGVpciBuYW1lcy5cbiAqXG4gKiBAcGFyYW0ge3N0cmluZ30gdGV4dFxuICogQHBhcmFtIHtzdHJpbmd9IGZpbGUgQWJzb2x1dGUgcGF0aC5cbiAqIEBwYXJhbSB7eyBzaHJpbms/OiBib29sZWFuLCBwYWdlPzogYm9vbGVhbiB9fSBvcHRpb25zIGBzaHJpbmtgOiBsZWF2ZXMgb3V0IGNvbW1lbnRzIGFuZCBzcGFjZXMsIGFuZCBzaG9ydGVucyBuYW1lcyBpblxuICogICBmdW5jdGlvbnMsIGZvciB3aGF0IGlzIHB1Ymxpc2hlZC4gYHBhZ2VgOiBlbXB0eSBsaW5lcyB0b28sIGZvciBhIHBhZ2UgdGhhdCBpcyBidWlsdCwgd2hpY2ggbmFtZXMgbm8gbGluZXMgb2YgaXRzXG4gKiAgIHNvdXJjZXMuXG4gKiBAcmV0dXJucyB7eyBjb2RlOiBzdHJpbmcsIG1hcDogeyB2ZXJzaW9uOiAzLCBzb3VyY2VzOiBzdHJpbmdbXSwgc291cmNlc0NvbnRlbnQ6IHN0cmluZ1tdLCBuYW1lczogc3RyaW5nW10sIG1hcHBpbmdzOlxuICogc3RyaW5nIH0gfX1cbiAqIEB0aHJvd3Mge1dlc2xFcnJvcn1cbiAqL1xuZXhwb3J0IGZ1bmN0aW9uIGNvbXBpbGVXZXNsKHRleHQsIGZpbGUsIHsgc2hyaW5rID0gZmFsc2UsIHBhZ2UgPSBmYWxzZSB9ID0ge30pIHtcbiAgY29uc3QgcGFyc2VkID0gcGFyc2VXZXNsKHRleHQsIGZpbGUpO1xuICBjb25zdCB7IGZvbGRlciwgc2hvcnQgfSA9IHBhY2thZ2VPZihmaWxlKTtcbiAgY29uc3Qgc291cmNlID0gam9pbihmb2xkZXIsICdzcmMnKTtcbiAgY29uc3QgbmFtZXMgPSBuZXcgTWFwKCk7XG4gIGNvbnN0IGRlcGVuZGVuY2llcyA9IG5ldyBNYXAoKTtcbiAgY29uc3QgbnVtYmVycyA9IG5ldyBNYXAoKTtcbiAgY29uc3QgdXNlZCA9IG5ldyBTZXQoWyd3Z3NsTW9kdWxlJ10pO1xuICBsZXQgaW1wb3J0cyA9ICcnO1xuICBmb3IgKGNvbnN0IGVudHJ5IG9mIHBhcnNlZC5pbXBvcnRzKSB7XG4gICAgaWYgKGlzSG9zdChlbnRyeS5wYXRoKSkgY29udGludWU7XG4gICAgY29uc3QgeyBmaWxlOiB0YXJnZXQsIHdlc2wgfSA9IHJlc29sdmVNb2R1bGUoZW50cnksIGZpbGUsIHNvdXJjZSk7XG4gICAgY29uc3Qgc3BlY2lmaWVyID0gYC4vJHtyZWxhdGl2ZShkaXJuYW1lKGZpbGUpLCB0YXJnZXQpLnNwbGl0KHNlcCkuam9pbignLycpfWBcbiAgICAgIC5yZXBsYWNlKC9eXFwuXFwvXFwuXFwuXFwvLywgJy4uLycpXG4gICAgICAucmVwbGFjZSgvXFwudHMkLywgJycpO1xuICAgIGlmICghd2VzbCAmJiBpc051bWJlcihlbnRyeS5uYW1lKSkge1xuICAgICAgaWYgKG51bWJlcnMuaGFzKGVudHJ5Lm5hbWUpKSBjb250aW51ZTtcbiAgICAgIG51bWJlcnMuc2V0KGVudHJ5Lm5hbWUsIGBudW1iZXIke251bWJlcnMuc2l6ZX1gKTtcbiAgICAgIGltcG9ydHMgKz0gYGltcG9ydCB7ICR7ZW50cnkubmFtZX0gYXMgJHtudW1iZXJzLmdldChlbnRyeS5uYW1lKX0gfSBmcm9tICR7SlNPTi5zdHJpbmdpZnkoc3BlY2lmaWVyKX07YDtcbiAgICAgIGNvbnRpbnVlO1xuICAgIH1cbiAgICBjb25zdCBrZXkgPSB3ZXNsID8gc3BlY2lmaWVyIDogYCR7c3BlY2lmaWVyfSAke2VudHJ5Lm5hbWV9YDtcbiAgICBsZXQgbmFtZSA9IG5hbWVzLmdldChrZXkpO1xuICAgIGlmIChuYW1lID09PSB1bmRlZmluZWQpIHtcbiAgICAgIG5hbWVzLnNldChrZXksIChuYW1lID0gYG1vZHVsZSR7bmFtZXMuc2l6ZX1gKSk7XG4gICAgICBpbXBvcnRzICs9IGBpbXBvcnQgJHt3ZXNsID8gbmFtZSA6IGB7ICR7ZW50cnkubmFtZX0gYXMgJHtuYW1lfSB9YH0gZnJvbSAke0pTT04uc3RyaW5naWZ5KHNwZWNpZmllcil9O2A7XG4gICAgfVxuICAgIGlmIChlbnRyeS5mbGFnICE9PSB1bmRlZmluZWQpIHVzZWQuYWRkKCdnYXRlZCcpO1xuICAgIGNvbnN0IGRlcGVuZGVuY3kgPVxuICAgICAgZW50cnkuZmxhZyA9PT0gdW5kZWZpbmVkID8gbmFtZSA6IGAvKiBAX19QVVJFX18gKi8gZ2F0ZWQoJHtKU09OLnN0cmluZ2lmeShlbnRyeS5mbGFnKX0sICR7bmFtZX0pYDtcbiAgICBkZXBlbmRlbmNpZXMuc2V0KGRlcGVuZGVuY3ksIGRlcGVuZGVuY3kpO1xuICB9XG4gIGNvbnN0IHRpdGxlID0gYCR7c2hvcnR9LyR7ZmlsZVxuICAgIC5zcGxpdCgvW1xcXFwvXS8pXG4gICAgLmF0KC0xKVxuICAgIC5yZXBsYWNlKC9cXC53ZXNsJC8sICcnKVxuICAgIC5yZXBsYWNlQWxsKCdfJywgJy0nKX1gO1xuICBjb25zdCBsaW5lcyA9IGdhdGVkVGV4dCh0ZXh0LCBwYXJzZWQsIHNocmluayB8fCBwYWdlKTtcbiAgY29uc3QgdGVtcGxhdGUgPSAocGFnZSA/IGxpbmVzLnJlcGxhY2UoL1xcblxcbisvZywgJ1xcbicpLnRyaW1TdGFydCgpIDogbGluZXMpXG4gICAgLnJlcGxhY2UoL1tcXFxcYF18XFwkKD89XFx7KS9nLCAnXFxcXCQmJylcbiAgICAucmVwbGFjZSgvW0EtWmEtel9dXFx3Ki9nLCAobmFtZSkgPT4gKG51bWJlcnMuaGFzKG5hbWUpID8gYFxcJHske251bWJlcnMuZ2V0KG5hbWUpfX11YCA6IG5hbWUpKTtcbiAgLy8gQWxsIG9uIHRoZSBmaXJzdCBsaW5lLCBzbyB0aGF0IGVhY2ggbGluZSBvZiB0aGUgcmVzdWx0IGlzIHRoYXQgb2YgdGhlIGZpbGUuXG4gIGNvbnN0IGNvZGUgPSBgaW1wb3J0IHsgJHtbLi4udXNlZF0uc29ydCgpLmpvaW4oJywgJyl9IH0gZnJvbSBcIkBnbGFuei93Z3NsL21vZHVsZVwiOyR7aW1wb3J0c31leHBvcnQgZGVmYXVsdCAvKiBAX19QVVJFX18gKi8gd2dzbE1vZHVsZSgke0pTT04uc3RyaW5naWZ5KHRpdGxlKX0sIFxcYCR7dGVtcGxhdGV9XFxgJHtkZXBlbmRlbmNpZXMuc2l6ZSA+IDAgPyBgLCBbJHtbLi4uZGVwZW5kZW5jaWVzLnZhbHVlcygpXS5qb2luKCcsICcpfV1gIDogJyd9KTtcXG5gO1xuICBjb25zdCBjb25zdGFudHMgPSByZWFkQ29uc3RhbnRzKHRleHQsIGZpbGUpO1xuICBjb25zdCBtYXBwaW5ncyA9IGBBQUFBJHsnO0FBQ0EnLnJlcGVhdCh0ZXh0LnNwbGl0KCdcXG4nKS5sZW5ndGggLSAxKX1gO1xuICByZXR1cm4ge1xuICAgIGNvZGU6IGNvbnN0YW50cyA/IGNvZGUgKyBleHBvcnRlZENvbnN0YW50cyhjb25zdGFudHMpIDogY29kZSxcbiAgICBtYXA6IHsgdmVyc2lvbjogMywgc291cmNlczogW2ZpbGUuc3BsaXQoL1tcXFxcL10vKS5hdCgtMSldLCBzb3VyY2VzQ29udGVudDogW3RleHRdLCBuYW1lczogW10sIG1hcHBpbmdzIH0sXG4gIH07XG59XG5cbi8qKiBGb3IgZXNidWlsZCBhbmQgdHN1cC4gQHBhcmFtIHt7IHNocmluaz86IGJvb2xlYW4sIHBhZ2U/OiBib29sZWFuIH19IG9wdGlvbnMgQXMgZm9yIHtAbGluayBjb21waWxlV2VzbH0uICovXG5leHBvcnQgY29uc3Qgd2VzbFNvdXJjZSA9IChvcHRpb25zID0ge30pID0+ICh7XG4gIG5hbWU6ICd3ZXNsJyxcbiAgc2V0dXAoYnVpbGQpIHtcbiAgICBidWlsZC5vbkxvYWQoeyBmaWx0ZXI6IC9cXC53ZXNsJC8gfSwgKHsgcGF0aCB9KSA9PiB7XG4gICAgICBjb25zdCB7IGNvZGUsIG1hcCB9ID0gY29tcGlsZVdlc2wocmVhZEZpbGVTeW5jKHBhdGgsICd1dGY4JyksIHBhdGgsIG9wdGlvbnMpO1xuICAgICAgcmV0dXJuIHtcbiAgICAgICAgY29udGVudHM6IGAke2NvZGV9Ly8jIHNvdXJjZU1hcHBpbmdVUkw9ZGF0YTphcHBsaWNhdGlvbi9qc29uO2Jhc2U2NCwke0J1ZmZlci5mcm9tKEpTT04uc3RyaW5naWZ5KG1hcCkpLnRvU3RyaW5nKCdiYXNlNjQnKX1gLFxuICAgICAgICBsb2FkZXI6ICdqcycsXG4gICAgICAgIHJlc29sdmVEaXI6IGRpcm5hbWUocGF0aCksXG4gICAgICB9O1xuICAgIH0pO1xuICB9LFxufSk7XG5cbi8qKiBGb3IgVml0ZSwgVml0ZXN0IGFuZCBWaXRlUHJlc3MuIFdoYXQgdGhleSBidWlsZCBhcmUgcGFnZXMuICovXG5leHBvcnQgY29uc3Qgd2VzbE1vZHVsZXMgPSAoKSA9PiB7XG4gIGxldCBwYWdlID0gZmFsc2U7XG4gIHJldHVybiB7XG4gICAgbmFtZTogJ3dlc2wnLFxuICAgIGVuZm9yY2U6ICdwcmUnLFxuICAgIGNvbmZpZ1Jlc29sdmVkOiAoeyBjb21tYW5kIH0pID0+IHZvaWQgKHBhZ2UgPSBjb21tYW5kID09PSAnYnVpbGQnKSxcbiAgICB0cmFuc2Zvcm06ICh0ZXh0LCBpZCkgPT4ge1xuICAgICAgaWYgKCFpZC5lbmRzV2l0aCgnLndlc2wnKSkgcmV0dXJuIHVuZGVmaW5lZDtcbiAgICAgIGNvbnN0IHsgY29kZSwgbWFwIH0gPSBjb21waWxlV2VzbCh0ZXh0LCBpZCwgeyBwYWdlIH0pO1xuICAgICAgcmV0dXJuIHsgY29kZSwgbWFwOiBwYWdlID8gbnVsbCA6IG1hcCB9O1xuICAgIH0sXG4gIH07XG59O1xuIiwgImNvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9kaXJuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ZpbGVuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wtY29uc3RhbnRzLm1qc1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwgPSBcImZpbGU6Ly8vdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wtY29uc3RhbnRzLm1qc1wiOy8vIENvbnN0YW50cyB0aGF0IHNoYWRlcnMgYW5kIFR5cGVTY3JpcHQgc2hhcmUgYXJlIHdyaXR0ZW4gb25jZSwgaW4gYSBXRVNMIGZpbGUgdGhhdCBob2xkcyBub3RoaW5nIGVsc2U6XG4vL1xuLy8gICAvLyBTYW1wbGVzIHdob3NlIG1lYW4gaXMgb25lIGVudHJ5IG9mIHRoZSBzdW0uXG4vLyAgIGNvbnN0IEZJTE1fQ0hVTksgPSAxNnU7XG4vLyAgIGNvbnN0IEJBTkRTID0gYXJyYXk8dmVjMmYsIDI+KHZlYzJmKDAuNSwgMS4wKSwgdmVjMmYoMS41LCAyLjApKTtcbi8vXG4vLyBJdHMgbW9kdWxlIGV4cG9ydHMgZWFjaCBvZiB0aGVtIGJ5IG5hbWU6IGEgbnVtYmVyIG9yIGJvb2xlYW4sIG9yIGFuIGFycmF5IG9mIHN1Y2guIGA8ZmlsZT4ud2VzbC5kLnRzYCBiZXNpZGUgaXRcbi8vIGRlY2xhcmVzIHRoZW0gdG8gVHlwZVNjcmlwdCwgd2l0aCB0aGVpciBjb21tZW50czogYG5vZGUgdG9vbHMvcGlwZWxpbmUvd2VzbC1jb25zdGFudHMubWpzYCB3cml0ZXMgaXQuXG5pbXBvcnQgeyBleGlzdHNTeW5jLCByZWFkRmlsZVN5bmMsIHJlYWRkaXJTeW5jLCB3cml0ZUZpbGVTeW5jIH0gZnJvbSAnbm9kZTpmcyc7XG5pbXBvcnQgeyBqb2luLCByZWxhdGl2ZSB9IGZyb20gJ25vZGU6cGF0aCc7XG5pbXBvcnQgeyBmaWxlVVJMVG9QYXRoIH0gZnJvbSAnbm9kZTp1cmwnO1xuaW1wb3J0IHsgV2VzbEVycm9yLCB0b2tlbml6ZSB9IGZyb20gJy4vd2VzbC10b2tlbnMubWpzJztcblxuY29uc3QgU0NBTEFSID0gL14oPzppMzJ8dTMyfGYzMnxmMTZ8Ym9vbCkkLztcbmNvbnN0IFZFQ1RPUiA9IC9edmVjKFsyMzRdKShbaXVmaF0/KSQvO1xuY29uc3QgTlVNQkVSID0gL14oPzowW3hYXVtcXGRhLWZBLUZdK1tpdV0/fCg/OlxcZCtcXC4/XFxkKnxcXC5cXGQrKSg/OltlRV1bLStdP1xcZCspP1tpdWZoXT8pJC87XG5cbi8qKiBUaGUgdmFsdWUgb2YgYSBsaXRlcmFsIG51bWJlciBhcyBXR1NMIHJlYWRzIGl0LiAqL1xuZnVuY3Rpb24gbnVtYmVyT2YodGV4dCkge1xuICBjb25zdCBoZXggPSAvXjBbeFhdLy50ZXN0KHRleHQpO1xuICByZXR1cm4gTnVtYmVyKHRleHQucmVwbGFjZShoZXggPyAvW2l1XSQvIDogL1tpdWZoXSQvLCAnJykpO1xufVxuXG4vKipcbiAqIFRoZSBjb25zdGFudHMgb2YgYSBmaWxlIHRoYXQgZGVjbGFyZXMgbm90aGluZyBlbHNlLCBvciBgdW5kZWZpbmVkYCBmb3IgYW55IG90aGVyIGZpbGUuIEEgZmlsZSBuYW1lZCBgY29uc3RhbnRzYCBtdXN0XG4gKiBiZSBvbmUuXG4gKlxuICogQHBhcmFtIHtzdHJpbmd9IHRleHRcbiAqIEBwYXJhbSB7c3RyaW5nfSBmaWxlIEZvciBtZXNzYWdlcy5cbiAqIEByZXR1cm5zIHt7IG5hbWU6IHN0cmluZywgdmFsdWU6IG51bWJlciB8IGJvb2xlYW4gfCByZWFkb25seSB1bmtub3duW10sIHR5cGU6IHN0cmluZywgZG9jOiBzdHJpbmcsIGxpbmU6IG51bWJlciB9W10gfFxuICogICB1bmRlZmluZWR9IGB0eXBlYCBpcyBUeXBlU2NyaXB0J3MsIGBkb2NgIHRoZSBsaW5lcyBvZiB0aGUgY29tbWVudCByaWdodCBiZWZvcmUgaXQuXG4gKiBAdGhyb3dzIHtXZXNsRXJyb3J9XG4gKi9cbmV4cG9ydCBmdW5jdGlvbiByZWFkQ29uc3RhbnRzKHRleHQsIGZpbGUgPSAnY29uc3RhbnRzLndlc2wnKSB7XG4gIGNvbnN0IGxpbmVPZiA9IChhdCkgPT4gdGV4dC5zbGljZSgwLCBhdCkuc3BsaXQoJ1xcbicpLmxlbmd0aDtcbiAgY29uc3QgZmFpbCA9IChhdCwgbWVzc2FnZSkgPT4ge1xuICAgIHRocm93IG5ldyBXZXNsRXJyb3IoYCR7ZmlsZX06JHtsaW5lT2YoYXQpfTogJHttZXNzYWdlfS5gKTtcbiAgfTtcbiAgY29uc3QgeyB0b2tlbnMsIGNvbW1lbnRzIH0gPSB0b2tlbml6ZSh0ZXh0LCBmYWlsKTtcbiAgY29uc3QgZGVtYW5kZWQgPSAvKF58W1xcXFwvXSljb25zdGFudHNcXC53ZXNsJC8udGVzdChmaWxlKTtcbiAgaWYgKCFkZW1hbmRlZCAmJiAhaG9sZHNPbmx5Q29uc3RhbnRzKHRva2VucykpIHJldHVybiB1bmRlZmluZWQ7XG4gIGxldCBuZXh0ID0gMDtcbiAgY29uc3QgcGVlayA9ICgpID0+IHRva2Vuc1tuZXh0XT8udGV4dDtcbiAgY29uc3QgaGVyZSA9ICgpID0+IHRva2Vuc1tuZXh0XT8uZnJvbSA/PyB0ZXh0Lmxlbmd0aDtcbiAgY29uc3QgdGFrZSA9IChleHBlY3RlZCkgPT4ge1xuICAgIGNvbnN0IHRva2VuID0gdG9rZW5zW25leHRdO1xuICAgIGlmICh0b2tlbiA9PT0gdW5kZWZpbmVkIHx8IChleHBlY3RlZCAhPT0gdW5kZWZpbmVkICYmIHRva2VuLnRleHQgIT09IGV4cGVjdGVkKSlcbiAgICAgIHJldHVybiBmYWlsKGhlcmUoKSwgYFwiJHt0b2tlbj8udGV4dCA/PyAndGhlIGVuZCd9XCIgc3RhbmRzIHdoZXJlIFwiJHtleHBlY3RlZCA/PyAnbW9yZSd9XCIgaXMgZXhwZWN0ZWRgKTtcbiAgICBuZXh0Kys7XG4gICAgcmV0dXJuIHRva2VuO1xuICB9O1xuXG4gIC8qKiBXaGF0IGEgdHlwZSdzIG5hbWUgYW5kIGl0cyBicmFja2V0cyBzYXk6IGhvdyBtYW55IGVsZW1lbnRzLCBhbmQgd2hhdCBlYWNoIGlzLiAqL1xuICBjb25zdCB0eXBlID0gKCkgPT4ge1xuICAgIGNvbnN0IGF0ID0gaGVyZSgpO1xuICAgIGNvbnN0IG5hbWUgPSB0YWtlKCkudGV4dDtcbiAgICBpZiAoU0NBTEFSLnRlc3QobmFtZSkpIHJldHVybiB7IGtpbmQ6ICdzY2FsYXInLCBzY2FsYXI6IG5hbWUgfTtcbiAgICBjb25zdCB2ZWN0b3IgPSBWRUNUT1IuZXhlYyhuYW1lKTtcbiAgICBpZiAodmVjdG9yKSB7XG4gICAgICBsZXQgc2NhbGFyID0geyBpOiAnaTMyJywgdTogJ3UzMicsIGY6ICdmMzInLCBoOiAnZjE2JyB9W3ZlY3RvclsyXV07XG4gICAgICBpZiAoc2NhbGFyID09PSB1bmRlZmluZWQgJiYgcGVlaygpID09PSAnPCcpIHtcbiAgICAgICAgdGFrZSgnPCcpO1xuICAgICAgICBjb25zdCBpbm5lciA9IHR5cGUoKTtcbiAgICAgICAgaWYgKGlubmVyLmtpbmQgIT09ICdzY2FsYXInKSBmYWlsKGF0LCAnYSB2ZWN0b3IgaG9sZHMgbnVtYmVycycpO1xuICAgICAgICBzY2FsYXIgPSBpbm5lci5zY2FsYXI7XG4gICAgICAgIHRha2UoJz4nKTtcbiAgICAgIH1cbiAgICAgIHJldHVybiB7IGtpbmQ6ICd2ZWN0b3InLCBjb3VudDogTnVtYmVyKHZlY3RvclsxXSksIHNjYWxhciB9O1xuICAgIH1cbiAgICBpZiAobmFtZSA9PT0gJ2FycmF5Jykge1xuICAgICAgaWYgKHBlZWsoKSAhPT0gJzwnKSByZXR1cm4geyBraW5kOiAnYXJyYXknIH07XG4gICAgICB0YWtlKCc8Jyk7XG4gICAgICBjb25zdCBlbGVtZW50ID0gdHlwZSgpO1xuICAgICAgbGV0IGNvdW50O1xuICAgICAgaWYgKHBlZWsoKSA9PT0gJywnKSB7XG4gICAgICAgIHRha2UoJywnKTtcbiAgICAgICAgY29uc3QgbGVuZ3RoID0gdGFrZSgpO1xuICAgICAgICBpZiAoIS9eXFxkK3U/JC8udGVzdChsZW5ndGgudGV4dCkpIGZhaWwobGVuZ3RoLmZyb20sICd0aGUgbGVuZ3RoIG9mIGFuIGFycmF5IGlzIGEgbGl0ZXJhbCcpO1xuICAgICAgICBjb3VudCA9IG51bWJlck9mKGxlbmd0aC50ZXh0KTtcbiAgICAgICAgaWYgKHBlZWsoKSA9PT0gJywnKSB0YWtlKCcsJyk7XG4gICAgICB9XG4gICAgICB0YWtlKCc+Jyk7XG4gICAgICByZXR1cm4geyBraW5kOiAnYXJyYXknLCBlbGVtZW50LCBjb3VudCB9O1xuICAgIH1cbiAgICByZXR1cm4gZmFpbChhdCwgYFwiJHtuYW1lfVwiIGlzIG5vIG51bWJlciwgYm9vbGVhbiwgdmVjdG9yIG9yIGFycmF5OiBhIHRhYmxlIG9mIGNvbnN0YW50cyBob2xkcyBsaXRlcmFsc2ApO1xuICB9O1xuXG4gIGNvbnN0IGNoZWNrID0gKGF0LCB2YWx1ZSwgd3JpdHRlbiwgc2NhbGFyKSA9PiB7XG4gICAgY29uc3Qgc3VmZml4ID0gL14wW3hYXS8udGVzdCh3cml0dGVuKSA/IC9baXVdJC8uZXhlYyh3cml0dGVuKT8uWzBdIDogL1tpdWZoXSQvLmV4ZWMod3JpdHRlbik/LlswXTtcbiAgICBjb25zdCBvd24gPSB7IGk6ICdpMzInLCB1OiAndTMyJywgZjogJ2YzMicsIGg6ICdmMTYnIH1bc3VmZml4XTtcbiAgICBjb25zdCBpcyA9IG93biA/PyBzY2FsYXI7XG4gICAgaWYgKG93biAhPT0gdW5kZWZpbmVkICYmIHNjYWxhciAhPT0gdW5kZWZpbmVkICYmIG93biAhPT0gc2NhbGFyKSBmYWlsKGF0LCBgJHt3cml0dGVufSBpcyBubyAke3NjYWxhcn1gKTtcbiAgICBpZiAoKGlzID09PSAnaTMyJyB8fCBpcyA9PT0gJ3UzMicpICYmICFOdW1iZXIuaXNJbnRlZ2VyKHZhbHVlKSkgZmFpbChhdCwgYCR7d3JpdHRlbn0gaXMgbm8gJHtpc31gKTtcbiAgICBpZiAoaXMgPT09ICdib29sJykgZmFpbChhdCwgYCR7d3JpdHRlbn0gaXMgbm8gYm9vbGApO1xuICAgIGNvbnN0IFtsb3csIGhpZ2hdID1cbiAgICAgIGlzID09PSAndTMyJyA/IFswLCAyICoqIDMyIC0gMV0gOiBpcyA9PT0gJ2kzMicgPyBbLSgyICoqIDMxKSwgMiAqKiAzMSAtIDFdIDogWy0zLjQwMjgyMzVlMzgsIDMuNDAyODIzNWUzOF07XG4gICAgaWYgKHZhbHVlIDwgbG93IHx8IHZhbHVlID4gaGlnaCkgZmFpbChhdCwgYCR7d3JpdHRlbn0gaXMgb3V0IG9mIHJhbmdlYCk7XG4gIH07XG5cbiAgLyoqIEByZXR1cm5zIHt7IHZhbHVlOiB1bmtub3duLCB0eXBlOiBzdHJpbmcgfX0gKi9cbiAgY29uc3QgZXhwcmVzc2lvbiA9ICh3YW50ZWQpID0+IHtcbiAgICBjb25zdCBhdCA9IGhlcmUoKTtcbiAgICBjb25zdCB0b2tlbiA9IHBlZWsoKTtcbiAgICBpZiAodG9rZW4gPT09ICd0cnVlJyB8fCB0b2tlbiA9PT0gJ2ZhbHNlJykge1xuICAgICAgaWYgKHdhbnRlZCAhPT0gdW5kZWZpbmVkICYmIHdhbnRlZC5zY2FsYXIgIT09ICdib29sJykgZmFpbChhdCwgYCR7dG9rZW59IHN0YW5kcyB3aGVyZSBhIG51bWJlciBpcyBleHBlY3RlZGApO1xuICAgICAgdGFrZSgpO1xuICAgICAgcmV0dXJuIHsgdmFsdWU6IHRva2VuID09PSAndHJ1ZScsIHR5cGU6ICdib29sZWFuJyB9O1xuICAgIH1cbiAgICBpZiAodG9rZW4gPT09ICctJyB8fCBOVU1CRVIudGVzdCh0b2tlbiA/PyAnJykpIHtcbiAgICAgIGlmICh3YW50ZWQgIT09IHVuZGVmaW5lZCAmJiB3YW50ZWQua2luZCAhPT0gJ3NjYWxhcicpIGZhaWwoYXQsICdhIG51bWJlciBzdGFuZHMgd2hlcmUgc2V2ZXJhbCBhcmUgZXhwZWN0ZWQnKTtcbiAgICAgIGlmICh0b2tlbiA9PT0gJy0nKSB0YWtlKCk7XG4gICAgICBjb25zdCB7IHRleHQ6IHdyaXR0ZW4sIGZyb20gfSA9IHRha2UoKTtcbiAgICAgIGlmICghTlVNQkVSLnRlc3Qod3JpdHRlbikpIGZhaWwoZnJvbSwgYFwiJHt3cml0dGVufVwiIGlzIG5vIGxpdGVyYWxgKTtcbiAgICAgIGNvbnN0IHZhbHVlID0gdG9rZW4gPT09ICctJyA/IC1udW1iZXJPZih3cml0dGVuKSA6IG51bWJlck9mKHdyaXR0ZW4pO1xuICAgICAgY2hlY2soZnJvbSwgdmFsdWUsIHdyaXR0ZW4sIHdhbnRlZD8uc2NhbGFyKTtcbiAgICAgIHJldHVybiB7IHZhbHVlLCB0eXBlOiAnbnVtYmVyJyB9O1xuICAgIH1cbiAgICBjb25zdCBmb3VuZCA9IHR5cGUoKTtcbiAgICBpZiAoZm91bmQua2luZCA9PT0gJ3NjYWxhcicpIGZhaWwoYXQsICdhIHRhYmxlIG9mIGNvbnN0YW50cyBjb252ZXJ0cyBubyB2YWx1ZXM6IHdyaXRlIHRoZSBsaXRlcmFsJyk7XG4gICAgaWYgKHdhbnRlZCAhPT0gdW5kZWZpbmVkICYmIHdhbnRlZC5raW5kICE9PSBmb3VuZC5raW5kKSBmYWlsKGF0LCAndGhlIHZhbHVlIGlzIG9mIGFub3RoZXIgdHlwZScpO1xuICAgIHRha2UoJygnKTtcbiAgICBjb25zdCBvZiA9IGZvdW5kLmtpbmQgPT09ICd2ZWN0b3InID8geyBraW5kOiAnc2NhbGFyJywgc2NhbGFyOiBmb3VuZC5zY2FsYXIgfSA6IGZvdW5kLmVsZW1lbnQ7XG4gICAgY29uc3QgZWxlbWVudHMgPSBbXTtcbiAgICB3aGlsZSAocGVlaygpICE9PSAnKScpIHtcbiAgICAgIGVsZW1lbnRzLnB1c2goZXhwcmVzc2lvbihvZikpO1xuICAgICAgaWYgKHBlZWsoKSAhPT0gJyknKSB0YWtlKCcsJyk7XG4gICAgfVxuICAgIHRha2UoJyknKTtcbiAgICBjb25zdCBjb3VudCA9IGZvdW5kLmNvdW50ID8/ICh3YW50ZWQ/LmtpbmQgPT09ICdhcnJheScgPyB3YW50ZWQuY291bnQgOiB1bmRlZmluZWQpID8/IGVsZW1lbnRzLmxlbmd0aDtcbiAgICBpZiAoZWxlbWVudHMubGVuZ3RoID09PSAwIHx8IGVsZW1lbnRzLmxlbmd0aCAhPT0gY291bnQpXG4gICAgICBmYWlsKGF0LCBgJHtlbGVtZW50cy5sZW5ndGh9IHZhbHVlcyBzdGFuZCB3aGVyZSAke2NvdW50IHx8ICdzb21lJ30gYXJlIGV4cGVjdGVkYCk7XG4gICAgY29uc3QgZWxlbWVudCA9IGVsZW1lbnRzWzBdLnR5cGU7XG4gICAgaWYgKGVsZW1lbnRzLnNvbWUoKHsgdHlwZTogb3RoZXIgfSkgPT4gb3RoZXIgIT09IGVsZW1lbnQpKSBmYWlsKGF0LCAndGhlIGVsZW1lbnRzIGFyZSBvZiBzZXZlcmFsIHR5cGVzJyk7XG4gICAgcmV0dXJuIHtcbiAgICAgIHZhbHVlOiBlbGVtZW50cy5tYXAoKHsgdmFsdWUgfSkgPT4gdmFsdWUpLFxuICAgICAgdHlwZTpcbiAgICAgICAgZm91bmQua2luZCA9PT0gJ3ZlY3RvcidcbiAgICAgICAgICA/IGByZWFkb25seSBbJHtlbGVtZW50cy5tYXAoKCkgPT4gZWxlbWVudCkuam9pbignLCAnKX1dYFxuICAgICAgICAgIDogYHJlYWRvbmx5ICR7L15cXHcrJC8udGVzdChlbGVtZW50KSA/IGVsZW1lbnQgOiBgKCR7ZWxlbWVudH0pYH1bXWAsXG4gICAgfTtcbiAgfTtcblxuICBjb25zdCBjb25zdGFudHMgPSBbXTtcbiAgd2hpbGUgKG5leHQgPCB0b2tlbnMubGVuZ3RoKSB7XG4gICAgY29uc3QgYXQgPSBoZXJlKCk7XG4gICAgaWYgKHBlZWsoKSAhPT0gJ2NvbnN0JylcbiAgICAgIGZhaWwoYXQsIGBcIiR7cGVlaygpfVwiIHN0YW5kcyBpbiBhIHRhYmxlIG9mIGNvbnN0YW50cywgd2hpY2ggaG9sZHMgXCJjb25zdCBOQU1FID0gbGl0ZXJhbDtcIiBhbG9uZWApO1xuICAgIHRha2UoKTtcbiAgICBjb25zdCBuYW1lID0gdGFrZSgpO1xuICAgIGlmIChjb25zdGFudHMuc29tZSgob3RoZXIpID0+IG90aGVyLm5hbWUgPT09IG5hbWUudGV4dCkpIGZhaWwobmFtZS5mcm9tLCBgJHtuYW1lLnRleHR9IGlzIGRlY2xhcmVkIHR3aWNlYCk7XG4gICAgbGV0IGRlY2xhcmVkO1xuICAgIGlmIChwZWVrKCkgPT09ICc6Jykge1xuICAgICAgdGFrZSgpO1xuICAgICAgZGVjbGFyZWQgPSB0eXBlKCk7XG4gICAgfVxuICAgIHRha2UoJz0nKTtcbiAgICBjb25zdCBmb3VuZCA9IGV4cHJlc3Npb24oZGVjbGFyZWQpO1xuICAgIGlmIChwZWVrKCkgIT09ICc7JykgZmFpbChoZXJlKCksIGBcIiR7cGVlaygpID8/ICd0aGUgZW5kJ31cIiBmb2xsb3dzIHRoZSBsaXRlcmFsOiB3cml0ZSB0aGUgdmFsdWUgaXRzZWxmYCk7XG4gICAgdGFrZSgnOycpO1xuICAgIGNvbnN0YW50cy5wdXNoKHsgbmFtZTogbmFtZS50ZXh0LCAuLi5mb3VuZCwgZG9jOiBjb21tZW50QmVmb3JlKHRleHQsIGNvbW1lbnRzLCBhdCksIGxpbmU6IGxpbmVPZihhdCkgfSk7XG4gIH1cbiAgaWYgKGNvbnN0YW50cy5sZW5ndGggPT09IDApIGZhaWwoMCwgJ2l0IGhvbGRzIG5vIGNvbnN0YW50Jyk7XG4gIHJldHVybiBjb25zdGFudHM7XG59XG5cbi8qKiBXaGV0aGVyIGFsbCBkZWNsYXJhdGlvbnMgYXJlIGBjb25zdGAsIHdpdGhvdXQgaW1wb3J0cywgZ2F0ZXMgb3IgYXR0cmlidXRlcy4gKi9cbmZ1bmN0aW9uIGhvbGRzT25seUNvbnN0YW50cyh0b2tlbnMpIHtcbiAgaWYgKHRva2Vucy5sZW5ndGggPT09IDApIHJldHVybiBmYWxzZTtcbiAgbGV0IGJlZ2lucyA9IHRydWU7XG4gIGZvciAoY29uc3QgeyB0ZXh0IH0gb2YgdG9rZW5zKSB7XG4gICAgaWYgKGJlZ2lucyAmJiB0ZXh0ICE9PSAnY29uc3QnKSByZXR1cm4gZmFsc2U7XG4gICAgYmVnaW5zID0gdGV4dCA9PT0gJzsnO1xuICB9XG4gIHJldHVybiB0cnVlO1xufVxuXG4vKiogVGhlIGxpbmVzIG9mIGAvL2AgZGlyZWN0bHkgYWJvdmUgYSBwbGFjZSwgd2l0aG91dCB0aGVpciBzbGFzaGVzLiAqL1xuZnVuY3Rpb24gY29tbWVudEJlZm9yZSh0ZXh0LCBjb21tZW50cywgYXQpIHtcbiAgY29uc3QgbGluZXMgPSBbXTtcbiAgbGV0IGJlbG93ID0gdGV4dC5sYXN0SW5kZXhPZignXFxuJywgYXQgLSAxKSArIDE7XG4gIGZvciAoY29uc3QgeyBmcm9tLCB0byB9IG9mIFsuLi5jb21tZW50c10ucmV2ZXJzZSgpKSB7XG4gICAgaWYgKGZyb20gPj0gYXQpIGNvbnRpbnVlO1xuICAgIGNvbnN0IGJlZ2luID0gdGV4dC5sYXN0SW5kZXhPZignXFxuJywgZnJvbSAtIDEpICsgMTtcbiAgICBpZiAodG8gKyAxICE9PSBiZWxvdyB8fCB0ZXh0LnNsaWNlKGJlZ2luLCBmcm9tKS50cmltKCkgIT09ICcnIHx8ICF0ZXh0LnN0YXJ0c1dpdGgoJy8vJywgZnJvbSkpIGJyZWFrO1xuICAgIGxpbmVzLnVuc2hpZnQodGV4dC5zbGljZShmcm9tICsgMiwgdG8pLnRyaW0oKSk7XG4gICAgYmVsb3cgPSBiZWdpbjtcbiAgfVxuICByZXR1cm4gbGluZXMuam9pbignXFxuJyk7XG59XG5cbi8qKiBUaGUgZXhwb3J0cyBvZiBhIG1vZHVsZSB3aXRoIHRoZXNlIGNvbnN0YW50cy4gKi9cbmV4cG9ydCBjb25zdCBleHBvcnRlZENvbnN0YW50cyA9IChjb25zdGFudHMpID0+XG4gIGBleHBvcnQgY29uc3QgJHtjb25zdGFudHMubWFwKCh7IG5hbWUsIHZhbHVlIH0pID0+IGAke25hbWV9ID0gJHtKU09OLnN0cmluZ2lmeSh2YWx1ZSl9YCkuam9pbignLCAnKX07XFxuYDtcblxuLyoqXG4gKiBXaGF0IGRlY2xhcmVzIGEgdGFibGUgb2YgY29uc3RhbnRzIHRvIFR5cGVTY3JpcHQuXG4gKiBAdGhyb3dzIHtXZXNsRXJyb3J9XG4gKi9cbmV4cG9ydCBmdW5jdGlvbiBkZWNsYXJlQ29uc3RhbnRzKHRleHQsIGZpbGUpIHtcbiAgY29uc3QgbGluZXMgPSBbXCJpbXBvcnQgdHlwZSB7IFdnc2xNb2R1bGUgfSBmcm9tICdAZ2xhbnovd2dzbCc7XCIsICcnXTtcbiAgZm9yIChjb25zdCB7IG5hbWUsIHR5cGUsIGRvYyB9IG9mIHJlYWRDb25zdGFudHModGV4dCwgZmlsZSkpIHtcbiAgICBjb25zdCBkb2NzID0gZG9jLnNwbGl0KCdcXG4nKTtcbiAgICBpZiAoZG9jICE9PSAnJyAmJiBkb2NzLmxlbmd0aCA9PT0gMSkgbGluZXMucHVzaChgLyoqICR7ZG9jfSAqL2ApO1xuICAgIGVsc2UgaWYgKGRvYyAhPT0gJycpIGxpbmVzLnB1c2goJy8qKicsIC4uLmRvY3MubWFwKChsaW5lKSA9PiBgICogJHtsaW5lfWAudHJpbUVuZCgpKSwgJyAqLycpO1xuICAgIGxpbmVzLnB1c2goYGV4cG9ydCBjb25zdCAke25hbWV9OiAke3R5cGV9O2ApO1xuICB9XG4gIHJldHVybiBgJHtsaW5lcy5qb2luKCdcXG4nKX1cXG5cXG5kZWNsYXJlIGNvbnN0IG1vZHVsZTogV2dzbE1vZHVsZTtcXG5leHBvcnQgZGVmYXVsdCBtb2R1bGU7XFxuYDtcbn1cblxuLyoqIFRoZSBmaWxlIHRoYXQgZGVjbGFyZXMgYSB0YWJsZSB0byBUeXBlU2NyaXB0LiAqL1xuZXhwb3J0IGNvbnN0IGRlY2xhcmF0aW9uRmlsZSA9IChmaWxlKSA9PiBgJHtmaWxlfS5kLnRzYDtcblxuLyoqIEFsbCB0YWJsZXMgb2YgY29uc3RhbnRzIGJlbG93IHRoZSBzb3VyY2VzIG9mIHRoZSBwYWNrYWdlcy4gQHJldHVybnMge3N0cmluZ1tdfSAqL1xuZXhwb3J0IGZ1bmN0aW9uIGNvbnN0YW50RmlsZXMocm9vdCkge1xuICByZXR1cm4gcmVhZGRpclN5bmMoam9pbihyb290LCAncGFja2FnZXMnKSlcbiAgICAubWFwKChuYW1lKSA9PiBqb2luKHJvb3QsICdwYWNrYWdlcycsIG5hbWUsICdzcmMnKSlcbiAgICAuZmlsdGVyKChmb2xkZXIpID0+IGV4aXN0c1N5bmMoZm9sZGVyKSlcbiAgICAuZmxhdE1hcCgoZm9sZGVyKSA9PiByZWFkZGlyU3luYyhmb2xkZXIsIHsgcmVjdXJzaXZlOiB0cnVlLCBlbmNvZGluZzogJ3V0ZjgnIH0pLm1hcCgocGF0aCkgPT4gam9pbihmb2xkZXIsIHBhdGgpKSlcbiAgICAuZmlsdGVyKChmaWxlKSA9PiBmaWxlLmVuZHNXaXRoKCcud2VzbCcpICYmIHJlYWRDb25zdGFudHMocmVhZEZpbGVTeW5jKGZpbGUsICd1dGY4JyksIGZpbGUpICE9PSB1bmRlZmluZWQpXG4gICAgLnNvcnQoKTtcbn1cblxuaWYgKHByb2Nlc3MuYXJndlsxXSA9PT0gZmlsZVVSTFRvUGF0aChpbXBvcnQubWV0YS51cmwpKSB7XG4gIGNvbnN0IHJvb3QgPSBqb2luKGltcG9ydC5tZXRhLmRpcm5hbWUsICcuLi8uLicpO1xuICBmb3IgKGNvbnN0IGZpbGUgb2YgY29uc3RhbnRGaWxlcyhyb290KSkge1xuICAgIHdyaXRlRmlsZVN5bmMoZGVjbGFyYXRpb25GaWxlKGZpbGUpLCBkZWNsYXJlQ29uc3RhbnRzKHJlYWRGaWxlU3luYyhmaWxlLCAndXRmOCcpLCBmaWxlKSk7XG4gICAgcHJvY2Vzcy5zdGRvdXQud3JpdGUoYCR7cmVsYXRpdmUocm9vdCwgZGVjbGFyYXRpb25GaWxlKGZpbGUpKX1cXG5gKTtcbiAgfVxufVxuIiwgImNvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9kaXJuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lXCI7Y29uc3QgX192aXRlX2luamVjdGVkX29yaWdpbmFsX2ZpbGVuYW1lID0gXCIvdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wtdG9rZW5zLm1qc1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwgPSBcImZpbGU6Ly8vdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wtdG9rZW5zLm1qc1wiOy8vIFRoZSB0b2tlbnMgb2YgYSBXRVNMIGZpbGUuXG5cbi8qKiBBIGAud2VzbGAgZmlsZSB0aGF0IGNhbm5vdCBiZSB0dXJuZWQgaW50byBhIG1vZHVsZTogd2hhdCBpcyB3cm9uZywgd2l0aCBmaWxlIGFuZCBsaW5lLiAqL1xuZXhwb3J0IGNsYXNzIFdlc2xFcnJvciBleHRlbmRzIEVycm9yIHtcbiAgbmFtZSA9ICdXZXNsRXJyb3InO1xufVxuXG5jb25zdCBUT0tFTiA9IC9cXC9cXC9bXlxcbl0qfFxcL1xcKnxbQS1aYS16X11cXHcqfCg/OlxcZHxcXC5cXGQpKD86W2VFcFBdWy0rXXxbXFx3Ll0pKnw6OnwmJnxcXHxcXHx8XFxTL2c7XG5cbi8qKlxuICogVG9rZW5zIHdpdGggdGhlaXIgcGxhY2VzLiBDb21tZW50cyBhcmUgbGlzdGVkIGFwYXJ0LlxuICpcbiAqIEBwYXJhbSB7c3RyaW5nfSB0ZXh0XG4gKiBAcGFyYW0geyhhdDogbnVtYmVyLCBtZXNzYWdlOiBzdHJpbmcpID0+IG5ldmVyfSBmYWlsXG4gKi9cbmV4cG9ydCBmdW5jdGlvbiB0b2tlbml6ZSh0ZXh0LCBmYWlsKSB7XG4gIGNvbnN0IHRva2VucyA9IFtdO1xuICBjb25zdCBjb21tZW50cyA9IFtdO1xuICBUT0tFTi5sYXN0SW5kZXggPSAwO1xuICBmb3IgKGxldCBtYXRjaDsgKG1hdGNoID0gVE9LRU4uZXhlYyh0ZXh0KSk7KSB7XG4gICAgY29uc3QgZnJvbSA9IG1hdGNoLmluZGV4O1xuICAgIGlmIChtYXRjaFswXSA9PT0gJy8qJykge1xuICAgICAgLy8gVGhleSBuZXN0LlxuICAgICAgbGV0IGRlcHRoID0gMDtcbiAgICAgIGNvbnN0IGVkZ2UgPSAvXFwvXFwqfFxcKlxcLy9nO1xuICAgICAgZWRnZS5sYXN0SW5kZXggPSBmcm9tO1xuICAgICAgZm9yIChsZXQgZm91bmQ7IChmb3VuZCA9IGVkZ2UuZXhlYyh0ZXh0KSk7KSB7XG4gICAgICAgIGRlcHRoICs9IGZvdW5kWzBdID09PSAnLyonID8gMSA6IC0xO1xuICAgICAgICBpZiAoZGVwdGggPT09IDApIGJyZWFrO1xuICAgICAgfVxuICAgICAgaWYgKGRlcHRoICE9PSAwKSBmYWlsKGZyb20sICdhIGJsb2NrIGNvbW1lbnQgbmV2ZXIgZW5kcycpO1xuICAgICAgY29tbWVudHMucHVzaCh7IGZyb20sIHRvOiBlZGdlLmxhc3RJbmRleCB9KTtcbiAgICAgIFRPS0VOLmxhc3RJbmRleCA9IGVkZ2UubGFzdEluZGV4O1xuICAgIH0gZWxzZSBpZiAobWF0Y2hbMF0uc3RhcnRzV2l0aCgnLy8nKSkgY29tbWVudHMucHVzaCh7IGZyb20sIHRvOiBUT0tFTi5sYXN0SW5kZXggfSk7XG4gICAgZWxzZSB0b2tlbnMucHVzaCh7IHRleHQ6IG1hdGNoWzBdLCBmcm9tLCB0bzogVE9LRU4ubGFzdEluZGV4IH0pO1xuICB9XG4gIHJldHVybiB7IHRva2VucywgY29tbWVudHMgfTtcbn1cbiIsICJjb25zdCBfX3ZpdGVfaW5qZWN0ZWRfb3JpZ2luYWxfZGlybmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZVwiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9maWxlbmFtZSA9IFwiL3RtcC93dC1tZS90b29scy9waXBlbGluZS93ZXNsLW5hbWVzLm1qc1wiO2NvbnN0IF9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwgPSBcImZpbGU6Ly8vdG1wL3d0LW1lL3Rvb2xzL3BpcGVsaW5lL3dlc2wtbmFtZXMubWpzXCI7Ly8gU2hvcnQgbmFtZXMgZm9yIHdoYXQgaXMgbG9jYWwgdG8gdGhlIGZ1bmN0aW9ucyBvZiBhIHNoYWRlciwgZm9yIHdoYXQgaXMgcHVibGlzaGVkOiBwYXJhbWV0ZXJzLCB2YXJpYWJsZXMgYW5kXG4vLyBjb25zdGFudHMgaW5zaWRlIG9mIGZ1bmN0aW9ucy4gTmFtZXMgdGhhdCBvdGhlciBtb2R1bGVzLCBob3N0cyBvciB1c2Vycycgb3duIFdHU0wgbWF5IHVzZSBzdGF5OiB0aG9zZSBvZiBmdW5jdGlvbnMsXG4vLyBzdHJ1Y3RzLCBtZW1iZXJzLCBjb25zdGFudHMgb2YgYSBtb2R1bGUuXG5cbi8qKiBOYW1lcyB0aGF0IGFyZSBuZXZlciBnaXZlbjogdGhlIGtleXdvcmRzIG9mIFdHU0wgd2l0aCBhdCBtb3N0IHR3byBsZXR0ZXJzLCBhbmQgYF9gLiAqL1xuY29uc3QgS0VZV09SRFMgPSBuZXcgU2V0KFsnXycsICdkbycsICdmbicsICdpZicsICdhcycsICdpcycsICdvZiddKTtcblxuLyoqIGEsIGIsIFx1MjAyNiB6LCBBLCBcdTIwMjYgWiwgYWEsIGFiLCBcdTIwMjYgKi9cbmZ1bmN0aW9uKiBzaG9ydE5hbWVzKCkge1xuICBjb25zdCBsZXR0ZXJzID0gJ2FiY2RlZmdoaWprbG1ub3BxcnN0dXZ3eHl6QUJDREVGR0hJSktMTU5PUFFSU1RVVldYWVonO1xuICBmb3IgKGNvbnN0IGxldHRlciBvZiBsZXR0ZXJzKSB5aWVsZCBsZXR0ZXI7XG4gIGZvciAoY29uc3QgZmlyc3Qgb2YgbGV0dGVycykgZm9yIChjb25zdCBzZWNvbmQgb2YgbGV0dGVycykgeWllbGQgZmlyc3QgKyBzZWNvbmQ7XG59XG5cbi8qKlxuICogQHBhcmFtIHt7IHRleHQ6IHN0cmluZywgZnJvbTogbnVtYmVyLCB0bzogbnVtYmVyIH1bXX0gdG9rZW5zIE9mIGEgV0VTTCBmaWxlLCB3aXRob3V0IGNvbW1lbnRzLlxuICogQHJldHVybnMge3sgZnJvbTogbnVtYmVyLCB0bzogbnVtYmVyLCB0ZXh0OiBzdHJpbmcgfVtdfSBSZXBsYWNlbWVudHMgb2YgbmFtZXMsIGVhY2ggbGluZSBpbiBpdHMgcGxhY2UuXG4gKi9cbmV4cG9ydCBmdW5jdGlvbiBzaG9ydGVuTG9jYWxzKHRva2Vucykge1xuICBjb25zdCBlZGl0cyA9IFtdO1xuICBjb25zdCBpZGVudGlmaWVycyA9IG5ldyBTZXQodG9rZW5zLm1hcCgoeyB0ZXh0IH0pID0+IHRleHQpKTtcbiAgY29uc3QgdGV4dCA9IChpKSA9PiB0b2tlbnNbaV0/LnRleHQ7XG4gIGxldCBpID0gMDtcblxuICAvKiogVGhlIHBsYWNlIGFmdGVyIHRoZSBicmFja2V0IHRoYXQgb3BlbnMgYXQgYGF0YC4gKi9cbiAgY29uc3QgYWZ0ZXJCcmFja2V0ID0gKGF0KSA9PiB7XG4gICAgbGV0IGRlcHRoID0gMDtcbiAgICBkbyB7XG4gICAgICBpZiAoJyhbeycuaW5jbHVkZXModGV4dChhdCkpKSBkZXB0aCsrO1xuICAgICAgaWYgKCcpXX0nLmluY2x1ZGVzKHRleHQoYXQpKSkgZGVwdGgtLTtcbiAgICAgIGF0Kys7XG4gICAgfSB3aGlsZSAoZGVwdGggPiAwICYmIGF0IDwgdG9rZW5zLmxlbmd0aCk7XG4gICAgcmV0dXJuIGF0O1xuICB9O1xuXG4gIGNvbnN0IGZ1bmN0aW9uQXQgPSAoKSA9PiB7XG4gICAgY29uc3QgbmFtZXMgPSBuZXcgTWFwKCk7XG4gICAgY29uc3QgY2FuZGlkYXRlcyA9IHNob3J0TmFtZXMoKTtcbiAgICBjb25zdCBzaG9ydEZvciA9IChuYW1lKSA9PiB7XG4gICAgICBsZXQgc2hvcnQgPSBuYW1lcy5nZXQobmFtZSk7XG4gICAgICB3aGlsZSAoc2hvcnQgPT09IHVuZGVmaW5lZCkge1xuICAgICAgICBjb25zdCB7IHZhbHVlIH0gPSBjYW5kaWRhdGVzLm5leHQoKTtcbiAgICAgICAgaWYgKHZhbHVlID09PSB1bmRlZmluZWQpIHNob3J0ID0gbmFtZTtcbiAgICAgICAgZWxzZSBpZiAoIWlkZW50aWZpZXJzLmhhcyh2YWx1ZSkgJiYgIUtFWVdPUkRTLmhhcyh2YWx1ZSkpIHNob3J0ID0gdmFsdWU7XG4gICAgICB9XG4gICAgICBuYW1lcy5zZXQobmFtZSwgc2hvcnQpO1xuICAgICAgcmV0dXJuIHNob3J0O1xuICAgIH07XG4gICAgLy8gTmFtZXMgYnkgdGhlIGJsb2NrIHRoYXQgZGVjbGFyZXMgdGhlbSwgdGhlIGlubmVybW9zdCBsYXN0LlxuICAgIGNvbnN0IHNjb3BlcyA9IFtuZXcgU2V0KCldO1xuICAgIGNvbnN0IGRlY2xhcmUgPSAobmFtZSkgPT4gc2NvcGVzLmF0KC0xKS5hZGQobmFtZSk7XG4gICAgY29uc3QgcmVwbGFjZSA9IChhdCkgPT4ge1xuICAgICAgY29uc3QgeyB0ZXh0OiBuYW1lLCBmcm9tLCB0byB9ID0gdG9rZW5zW2F0XTtcbiAgICAgIGNvbnN0IHNob3J0ID0gc2hvcnRGb3IobmFtZSk7XG4gICAgICBpZiAoc2hvcnQubGVuZ3RoIDwgbmFtZS5sZW5ndGgpIGVkaXRzLnB1c2goeyBmcm9tLCB0bywgdGV4dDogc2hvcnQgfSk7XG4gICAgfTtcbiAgICAvKiogQW4gYXR0cmlidXRlIHdpdGggaXRzIGFyZ3VtZW50cywgd2hpY2ggYXJlIG5vIG5hbWVzIG9mIG91cnMuICovXG4gICAgY29uc3Qgc2tpcEF0dHJpYnV0ZSA9ICgpID0+IHtcbiAgICAgIGkgKz0gMjtcbiAgICAgIGlmICh0ZXh0KGkpID09PSAnKCcpIGkgPSBhZnRlckJyYWNrZXQoaSk7XG4gICAgfTtcblxuICAgIGkgKz0gMjtcbiAgICAvLyBQYXJhbWV0ZXJzOiBhIG5hbWUgYmVmb3JlIGEgY29sb24sIG91dHNpZGUgb2YgdHlwZXMuXG4gICAgZm9yIChsZXQgZGVwdGggPSAwOyA7KSB7XG4gICAgICBjb25zdCB0b2tlbiA9IHRleHQoaSk7XG4gICAgICBpZiAodG9rZW4gPT09ICdAJykge1xuICAgICAgICBza2lwQXR0cmlidXRlKCk7XG4gICAgICAgIGNvbnRpbnVlO1xuICAgICAgfVxuICAgICAgaWYgKHRva2VuID09PSAnKCcgfHwgdG9rZW4gPT09ICc8JykgZGVwdGgrKztcbiAgICAgIGlmICh0b2tlbiA9PT0gJyknIHx8IHRva2VuID09PSAnPicpIGRlcHRoLS07XG4gICAgICBpZiAoZGVwdGggPT09IDEgJiYgdGV4dChpICsgMSkgPT09ICc6JyAmJiAvXltBLVphLXpfXS8udGVzdCh0b2tlbikpIHtcbiAgICAgICAgZGVjbGFyZSh0b2tlbik7XG4gICAgICAgIHJlcGxhY2UoaSk7XG4gICAgICB9XG4gICAgICBpKys7XG4gICAgICBpZiAoZGVwdGggPT09IDApIGJyZWFrO1xuICAgIH1cbiAgICB3aGlsZSAodGV4dChpKSAhPT0gJ3snKSBpICs9IDE7XG5cbiAgICAvLyBXaGF0IGEgc3RhdGVtZW50IGRlY2xhcmVzIGlzIGtub3duIGFmdGVyIGl0OiBgbGV0IHggPSBmKHgpO2AgcmVhZHMgYW5vdGhlciB4LlxuICAgIGxldCBwZW5kaW5nID0gW107XG4gICAgLy8gRGVwdGhzIG9mIGJyYWNrZXRzIGF0IHdoaWNoIHRoZSBoZWFkcyBvZiBsb29wcyBiZWdhbjogdGhlaXIgdmFyaWFibGVzIGxpdmUgYXMgbG9uZyBhcyB0aGUgYmxvY2sgYWZ0ZXIgaXQuXG4gICAgY29uc3QgaGVhZHMgPSBbXTtcbiAgICBsZXQgcm91bmQgPSAwO1xuICAgIGNvbnN0IHNldHRsZSA9ICgpID0+IHtcbiAgICAgIHBlbmRpbmcuZm9yRWFjaChkZWNsYXJlKTtcbiAgICAgIHBlbmRpbmcgPSBbXTtcbiAgICB9O1xuICAgIGxldCBkZXB0aCA9IDA7XG4gICAgZG8ge1xuICAgICAgY29uc3QgdG9rZW4gPSB0ZXh0KGkpO1xuICAgICAgaWYgKHRva2VuID09PSAnQCcpIHtcbiAgICAgICAgc2tpcEF0dHJpYnV0ZSgpO1xuICAgICAgICBjb250aW51ZTtcbiAgICAgIH1cbiAgICAgIGlmICh0b2tlbiA9PT0gJ2ZvcicpIHtcbiAgICAgICAgc2NvcGVzLnB1c2gobmV3IFNldCgpKTtcbiAgICAgICAgaGVhZHMucHVzaCh7IGRlcHRoLCByb3VuZCB9KTtcbiAgICAgIH0gZWxzZSBpZiAodG9rZW4gPT09ICcoJykgcm91bmQrKztcbiAgICAgIGVsc2UgaWYgKHRva2VuID09PSAnKScpIHJvdW5kLS07XG4gICAgICBlbHNlIGlmICh0b2tlbiA9PT0gJzsnKSBzZXR0bGUoKTtcbiAgICAgIGVsc2UgaWYgKHRva2VuID09PSAneycpIHtcbiAgICAgICAgc2V0dGxlKCk7XG4gICAgICAgIGRlcHRoKys7XG4gICAgICAgIHNjb3Blcy5wdXNoKG5ldyBTZXQoKSk7XG4gICAgICB9IGVsc2UgaWYgKHRva2VuID09PSAnfScpIHtcbiAgICAgICAgc2V0dGxlKCk7XG4gICAgICAgIGRlcHRoLS07XG4gICAgICAgIHNjb3Blcy5wb3AoKTtcbiAgICAgICAgaWYgKGhlYWRzLmF0KC0xKT8uZGVwdGggPT09IGRlcHRoICYmIGhlYWRzLmF0KC0xKS5yb3VuZCA9PT0gcm91bmQpIHtcbiAgICAgICAgICBoZWFkcy5wb3AoKTtcbiAgICAgICAgICBzY29wZXMucG9wKCk7XG4gICAgICAgIH1cbiAgICAgIH0gZWxzZSBpZiAoL14obGV0fHZhcnxjb25zdCkkLy50ZXN0KHRva2VuKSkge1xuICAgICAgICBsZXQgYXQgPSBpICsgMTtcbiAgICAgICAgaWYgKHRleHQoYXQpID09PSAnPCcpIHdoaWxlICh0ZXh0KGF0KyspICE9PSAnPicpO1xuICAgICAgICBwZW5kaW5nLnB1c2godGV4dChhdCkpO1xuICAgICAgICAvLyBVcCB0byB0aGUgbmFtZTsgaXQgaXMgcmVwbGFjZWQgaGVyZSwgc2luY2UgaXQgaXMgbm90IGtub3duIHlldC5cbiAgICAgICAgcmVwbGFjZShhdCk7XG4gICAgICAgIGkgPSBhdDtcbiAgICAgIH0gZWxzZSBpZiAoL15bQS1aYS16X10vLnRlc3QodG9rZW4pICYmIHRleHQoaSAtIDEpICE9PSAnLicgJiYgc2NvcGVzLnNvbWUoKHNjb3BlKSA9PiBzY29wZS5oYXModG9rZW4pKSlcbiAgICAgICAgcmVwbGFjZShpKTtcbiAgICAgIGkrKztcbiAgICB9IHdoaWxlIChkZXB0aCA+IDApO1xuICB9O1xuXG4gIHdoaWxlIChpIDwgdG9rZW5zLmxlbmd0aCkge1xuICAgIGlmICh0ZXh0KGkpID09PSAnZm4nKSBmdW5jdGlvbkF0KCk7XG4gICAgZWxzZSBpKys7XG4gIH1cbiAgcmV0dXJuIGVkaXRzO1xufVxuIl0sCiAgIm1hcHBpbmdzIjogIjtBQUNBLFNBQVMsb0JBQW9COzs7QUNENk4sU0FBUyxpQkFBQUEsc0JBQXFCO0FBQ3hSLFNBQVMsYUFBYTs7O0FDTXRCLFNBQVMsY0FBQUMsYUFBWSxnQkFBQUMscUJBQW9CO0FBQ3pDLFNBQVMsU0FBUyxRQUFBQyxPQUFNLFlBQUFDLFdBQVUsU0FBUyxXQUFXOzs7QUNBdEQsU0FBUyxZQUFZLGNBQWMsYUFBYSxxQkFBcUI7QUFDckUsU0FBUyxNQUFNLGdCQUFnQjtBQUMvQixTQUFTLHFCQUFxQjs7O0FDUHZCLElBQU0sWUFBTixjQUF3QixNQUFNO0FBQUEsRUFDbkMsT0FBTztBQUNUO0FBRUEsSUFBTSxRQUFRO0FBUVAsU0FBUyxTQUFTLE1BQU0sTUFBTTtBQUNuQyxRQUFNLFNBQVMsQ0FBQztBQUNoQixRQUFNLFdBQVcsQ0FBQztBQUNsQixRQUFNLFlBQVk7QUFDbEIsV0FBUyxPQUFRLFFBQVEsTUFBTSxLQUFLLElBQUksS0FBSztBQUMzQyxVQUFNLE9BQU8sTUFBTTtBQUNuQixRQUFJLE1BQU0sQ0FBQyxNQUFNLE1BQU07QUFFckIsVUFBSSxRQUFRO0FBQ1osWUFBTSxPQUFPO0FBQ2IsV0FBSyxZQUFZO0FBQ2pCLGVBQVMsT0FBUSxRQUFRLEtBQUssS0FBSyxJQUFJLEtBQUs7QUFDMUMsaUJBQVMsTUFBTSxDQUFDLE1BQU0sT0FBTyxJQUFJO0FBQ2pDLFlBQUksVUFBVSxFQUFHO0FBQUEsTUFDbkI7QUFDQSxVQUFJLFVBQVUsRUFBRyxNQUFLLE1BQU0sNEJBQTRCO0FBQ3hELGVBQVMsS0FBSyxFQUFFLE1BQU0sSUFBSSxLQUFLLFVBQVUsQ0FBQztBQUMxQyxZQUFNLFlBQVksS0FBSztBQUFBLElBQ3pCLFdBQVcsTUFBTSxDQUFDLEVBQUUsV0FBVyxJQUFJLEVBQUcsVUFBUyxLQUFLLEVBQUUsTUFBTSxJQUFJLE1BQU0sVUFBVSxDQUFDO0FBQUEsUUFDNUUsUUFBTyxLQUFLLEVBQUUsTUFBTSxNQUFNLENBQUMsR0FBRyxNQUFNLElBQUksTUFBTSxVQUFVLENBQUM7QUFBQSxFQUNoRTtBQUNBLFNBQU8sRUFBRSxRQUFRLFNBQVM7QUFDNUI7OztBRHJDQSxJQUFNLG1DQUFtQztBQUFxSCxJQUFNLDJDQUEyQztBQWEvTSxJQUFNLFNBQVM7QUFDZixJQUFNLFNBQVM7QUFDZixJQUFNLFNBQVM7QUFHZixTQUFTLFNBQVMsTUFBTTtBQUN0QixRQUFNLE1BQU0sU0FBUyxLQUFLLElBQUk7QUFDOUIsU0FBTyxPQUFPLEtBQUssUUFBUSxNQUFNLFVBQVUsV0FBVyxFQUFFLENBQUM7QUFDM0Q7QUFZTyxTQUFTLGNBQWMsTUFBTSxPQUFPLGtCQUFrQjtBQUMzRCxRQUFNLFNBQVMsQ0FBQyxPQUFPLEtBQUssTUFBTSxHQUFHLEVBQUUsRUFBRSxNQUFNLElBQUksRUFBRTtBQUNyRCxRQUFNLE9BQU8sQ0FBQyxJQUFJLFlBQVk7QUFDNUIsVUFBTSxJQUFJLFVBQVUsR0FBRyxJQUFJLElBQUksT0FBTyxFQUFFLENBQUMsS0FBSyxPQUFPLEdBQUc7QUFBQSxFQUMxRDtBQUNBLFFBQU0sRUFBRSxRQUFRLFNBQVMsSUFBSSxTQUFTLE1BQU0sSUFBSTtBQUNoRCxRQUFNLFdBQVcsNEJBQTRCLEtBQUssSUFBSTtBQUN0RCxNQUFJLENBQUMsWUFBWSxDQUFDLG1CQUFtQixNQUFNLEVBQUcsUUFBTztBQUNyRCxNQUFJLE9BQU87QUFDWCxRQUFNLE9BQU8sTUFBTSxPQUFPLElBQUksR0FBRztBQUNqQyxRQUFNLE9BQU8sTUFBTSxPQUFPLElBQUksR0FBRyxRQUFRLEtBQUs7QUFDOUMsUUFBTSxPQUFPLENBQUMsYUFBYTtBQUN6QixVQUFNLFFBQVEsT0FBTyxJQUFJO0FBQ3pCLFFBQUksVUFBVSxVQUFjLGFBQWEsVUFBYSxNQUFNLFNBQVM7QUFDbkUsYUFBTyxLQUFLLEtBQUssR0FBRyxJQUFJLE9BQU8sUUFBUSxTQUFTLG1CQUFtQixZQUFZLE1BQU0sZUFBZTtBQUN0RztBQUNBLFdBQU87QUFBQSxFQUNUO0FBR0EsUUFBTSxPQUFPLE1BQU07QUFDakIsVUFBTSxLQUFLLEtBQUs7QUFDaEIsVUFBTSxPQUFPLEtBQUssRUFBRTtBQUNwQixRQUFJLE9BQU8sS0FBSyxJQUFJLEVBQUcsUUFBTyxFQUFFLE1BQU0sVUFBVSxRQUFRLEtBQUs7QUFDN0QsVUFBTSxTQUFTLE9BQU8sS0FBSyxJQUFJO0FBQy9CLFFBQUksUUFBUTtBQUNWLFVBQUksU0FBUyxFQUFFLEdBQUcsT0FBTyxHQUFHLE9BQU8sR0FBRyxPQUFPLEdBQUcsTUFBTSxFQUFFLE9BQU8sQ0FBQyxDQUFDO0FBQ2pFLFVBQUksV0FBVyxVQUFhLEtBQUssTUFBTSxLQUFLO0FBQzFDLGFBQUssR0FBRztBQUNSLGNBQU0sUUFBUSxLQUFLO0FBQ25CLFlBQUksTUFBTSxTQUFTLFNBQVUsTUFBSyxJQUFJLHdCQUF3QjtBQUM5RCxpQkFBUyxNQUFNO0FBQ2YsYUFBSyxHQUFHO0FBQUEsTUFDVjtBQUNBLGFBQU8sRUFBRSxNQUFNLFVBQVUsT0FBTyxPQUFPLE9BQU8sQ0FBQyxDQUFDLEdBQUcsT0FBTztBQUFBLElBQzVEO0FBQ0EsUUFBSSxTQUFTLFNBQVM7QUFDcEIsVUFBSSxLQUFLLE1BQU0sSUFBSyxRQUFPLEVBQUUsTUFBTSxRQUFRO0FBQzNDLFdBQUssR0FBRztBQUNSLFlBQU0sVUFBVSxLQUFLO0FBQ3JCLFVBQUk7QUFDSixVQUFJLEtBQUssTUFBTSxLQUFLO0FBQ2xCLGFBQUssR0FBRztBQUNSLGNBQU0sU0FBUyxLQUFLO0FBQ3BCLFlBQUksQ0FBQyxVQUFVLEtBQUssT0FBTyxJQUFJLEVBQUcsTUFBSyxPQUFPLE1BQU0scUNBQXFDO0FBQ3pGLGdCQUFRLFNBQVMsT0FBTyxJQUFJO0FBQzVCLFlBQUksS0FBSyxNQUFNLElBQUssTUFBSyxHQUFHO0FBQUEsTUFDOUI7QUFDQSxXQUFLLEdBQUc7QUFDUixhQUFPLEVBQUUsTUFBTSxTQUFTLFNBQVMsTUFBTTtBQUFBLElBQ3pDO0FBQ0EsV0FBTyxLQUFLLElBQUksSUFBSSxJQUFJLCtFQUErRTtBQUFBLEVBQ3pHO0FBRUEsUUFBTSxRQUFRLENBQUMsSUFBSSxPQUFPLFNBQVMsV0FBVztBQUM1QyxVQUFNLFNBQVMsU0FBUyxLQUFLLE9BQU8sSUFBSSxRQUFRLEtBQUssT0FBTyxJQUFJLENBQUMsSUFBSSxVQUFVLEtBQUssT0FBTyxJQUFJLENBQUM7QUFDaEcsVUFBTSxNQUFNLEVBQUUsR0FBRyxPQUFPLEdBQUcsT0FBTyxHQUFHLE9BQU8sR0FBRyxNQUFNLEVBQUUsTUFBTTtBQUM3RCxVQUFNLEtBQUssT0FBTztBQUNsQixRQUFJLFFBQVEsVUFBYSxXQUFXLFVBQWEsUUFBUSxPQUFRLE1BQUssSUFBSSxHQUFHLE9BQU8sVUFBVSxNQUFNLEVBQUU7QUFDdEcsU0FBSyxPQUFPLFNBQVMsT0FBTyxVQUFVLENBQUMsT0FBTyxVQUFVLEtBQUssRUFBRyxNQUFLLElBQUksR0FBRyxPQUFPLFVBQVUsRUFBRSxFQUFFO0FBQ2pHLFFBQUksT0FBTyxPQUFRLE1BQUssSUFBSSxHQUFHLE9BQU8sYUFBYTtBQUNuRCxVQUFNLENBQUMsS0FBSyxJQUFJLElBQ2QsT0FBTyxRQUFRLENBQUMsR0FBRyxLQUFLLEtBQUssQ0FBQyxJQUFJLE9BQU8sUUFBUSxDQUFDLEVBQUUsS0FBSyxLQUFLLEtBQUssS0FBSyxDQUFDLElBQUksQ0FBQyxjQUFlLFdBQVk7QUFDM0csUUFBSSxRQUFRLE9BQU8sUUFBUSxLQUFNLE1BQUssSUFBSSxHQUFHLE9BQU8sa0JBQWtCO0FBQUEsRUFDeEU7QUFHQSxRQUFNLGFBQWEsQ0FBQyxXQUFXO0FBQzdCLFVBQU0sS0FBSyxLQUFLO0FBQ2hCLFVBQU0sUUFBUSxLQUFLO0FBQ25CLFFBQUksVUFBVSxVQUFVLFVBQVUsU0FBUztBQUN6QyxVQUFJLFdBQVcsVUFBYSxPQUFPLFdBQVcsT0FBUSxNQUFLLElBQUksR0FBRyxLQUFLLG9DQUFvQztBQUMzRyxXQUFLO0FBQ0wsYUFBTyxFQUFFLE9BQU8sVUFBVSxRQUFRLE1BQU0sVUFBVTtBQUFBLElBQ3BEO0FBQ0EsUUFBSSxVQUFVLE9BQU8sT0FBTyxLQUFLLFNBQVMsRUFBRSxHQUFHO0FBQzdDLFVBQUksV0FBVyxVQUFhLE9BQU8sU0FBUyxTQUFVLE1BQUssSUFBSSw0Q0FBNEM7QUFDM0csVUFBSSxVQUFVLElBQUssTUFBSztBQUN4QixZQUFNLEVBQUUsTUFBTSxTQUFTLEtBQUssSUFBSSxLQUFLO0FBQ3JDLFVBQUksQ0FBQyxPQUFPLEtBQUssT0FBTyxFQUFHLE1BQUssTUFBTSxJQUFJLE9BQU8saUJBQWlCO0FBQ2xFLFlBQU0sUUFBUSxVQUFVLE1BQU0sQ0FBQyxTQUFTLE9BQU8sSUFBSSxTQUFTLE9BQU87QUFDbkUsWUFBTSxNQUFNLE9BQU8sU0FBUyxRQUFRLE1BQU07QUFDMUMsYUFBTyxFQUFFLE9BQU8sTUFBTSxTQUFTO0FBQUEsSUFDakM7QUFDQSxVQUFNLFFBQVEsS0FBSztBQUNuQixRQUFJLE1BQU0sU0FBUyxTQUFVLE1BQUssSUFBSSw0REFBNEQ7QUFDbEcsUUFBSSxXQUFXLFVBQWEsT0FBTyxTQUFTLE1BQU0sS0FBTSxNQUFLLElBQUksOEJBQThCO0FBQy9GLFNBQUssR0FBRztBQUNSLFVBQU0sS0FBSyxNQUFNLFNBQVMsV0FBVyxFQUFFLE1BQU0sVUFBVSxRQUFRLE1BQU0sT0FBTyxJQUFJLE1BQU07QUFDdEYsVUFBTSxXQUFXLENBQUM7QUFDbEIsV0FBTyxLQUFLLE1BQU0sS0FBSztBQUNyQixlQUFTLEtBQUssV0FBVyxFQUFFLENBQUM7QUFDNUIsVUFBSSxLQUFLLE1BQU0sSUFBSyxNQUFLLEdBQUc7QUFBQSxJQUM5QjtBQUNBLFNBQUssR0FBRztBQUNSLFVBQU0sUUFBUSxNQUFNLFVBQVUsUUFBUSxTQUFTLFVBQVUsT0FBTyxRQUFRLFdBQWMsU0FBUztBQUMvRixRQUFJLFNBQVMsV0FBVyxLQUFLLFNBQVMsV0FBVztBQUMvQyxXQUFLLElBQUksR0FBRyxTQUFTLE1BQU0sdUJBQXVCLFNBQVMsTUFBTSxlQUFlO0FBQ2xGLFVBQU0sVUFBVSxTQUFTLENBQUMsRUFBRTtBQUM1QixRQUFJLFNBQVMsS0FBSyxDQUFDLEVBQUUsTUFBTSxNQUFNLE1BQU0sVUFBVSxPQUFPLEVBQUcsTUFBSyxJQUFJLG1DQUFtQztBQUN2RyxXQUFPO0FBQUEsTUFDTCxPQUFPLFNBQVMsSUFBSSxDQUFDLEVBQUUsTUFBTSxNQUFNLEtBQUs7QUFBQSxNQUN4QyxNQUNFLE1BQU0sU0FBUyxXQUNYLGFBQWEsU0FBUyxJQUFJLE1BQU0sT0FBTyxFQUFFLEtBQUssSUFBSSxDQUFDLE1BQ25ELFlBQVksUUFBUSxLQUFLLE9BQU8sSUFBSSxVQUFVLElBQUksT0FBTyxHQUFHO0FBQUEsSUFDcEU7QUFBQSxFQUNGO0FBRUEsUUFBTSxZQUFZLENBQUM7QUFDbkIsU0FBTyxPQUFPLE9BQU8sUUFBUTtBQUMzQixVQUFNLEtBQUssS0FBSztBQUNoQixRQUFJLEtBQUssTUFBTTtBQUNiLFdBQUssSUFBSSxJQUFJLEtBQUssQ0FBQyw2RUFBNkU7QUFDbEcsU0FBSztBQUNMLFVBQU0sT0FBTyxLQUFLO0FBQ2xCLFFBQUksVUFBVSxLQUFLLENBQUMsVUFBVSxNQUFNLFNBQVMsS0FBSyxJQUFJLEVBQUcsTUFBSyxLQUFLLE1BQU0sR0FBRyxLQUFLLElBQUksb0JBQW9CO0FBQ3pHLFFBQUk7QUFDSixRQUFJLEtBQUssTUFBTSxLQUFLO0FBQ2xCLFdBQUs7QUFDTCxpQkFBVyxLQUFLO0FBQUEsSUFDbEI7QUFDQSxTQUFLLEdBQUc7QUFDUixVQUFNLFFBQVEsV0FBVyxRQUFRO0FBQ2pDLFFBQUksS0FBSyxNQUFNLElBQUssTUFBSyxLQUFLLEdBQUcsSUFBSSxLQUFLLEtBQUssU0FBUywrQ0FBK0M7QUFDdkcsU0FBSyxHQUFHO0FBQ1IsY0FBVSxLQUFLLEVBQUUsTUFBTSxLQUFLLE1BQU0sR0FBRyxPQUFPLEtBQUssY0FBYyxNQUFNLFVBQVUsRUFBRSxHQUFHLE1BQU0sT0FBTyxFQUFFLEVBQUUsQ0FBQztBQUFBLEVBQ3hHO0FBQ0EsTUFBSSxVQUFVLFdBQVcsRUFBRyxNQUFLLEdBQUcsc0JBQXNCO0FBQzFELFNBQU87QUFDVDtBQUdBLFNBQVMsbUJBQW1CLFFBQVE7QUFDbEMsTUFBSSxPQUFPLFdBQVcsRUFBRyxRQUFPO0FBQ2hDLE1BQUksU0FBUztBQUNiLGFBQVcsRUFBRSxLQUFLLEtBQUssUUFBUTtBQUM3QixRQUFJLFVBQVUsU0FBUyxRQUFTLFFBQU87QUFDdkMsYUFBUyxTQUFTO0FBQUEsRUFDcEI7QUFDQSxTQUFPO0FBQ1Q7QUFHQSxTQUFTLGNBQWMsTUFBTSxVQUFVLElBQUk7QUFDekMsUUFBTSxRQUFRLENBQUM7QUFDZixNQUFJLFFBQVEsS0FBSyxZQUFZLE1BQU0sS0FBSyxDQUFDLElBQUk7QUFDN0MsYUFBVyxFQUFFLE1BQU0sR0FBRyxLQUFLLENBQUMsR0FBRyxRQUFRLEVBQUUsUUFBUSxHQUFHO0FBQ2xELFFBQUksUUFBUSxHQUFJO0FBQ2hCLFVBQU0sUUFBUSxLQUFLLFlBQVksTUFBTSxPQUFPLENBQUMsSUFBSTtBQUNqRCxRQUFJLEtBQUssTUFBTSxTQUFTLEtBQUssTUFBTSxPQUFPLElBQUksRUFBRSxLQUFLLE1BQU0sTUFBTSxDQUFDLEtBQUssV0FBVyxNQUFNLElBQUksRUFBRztBQUMvRixVQUFNLFFBQVEsS0FBSyxNQUFNLE9BQU8sR0FBRyxFQUFFLEVBQUUsS0FBSyxDQUFDO0FBQzdDLFlBQVE7QUFBQSxFQUNWO0FBQ0EsU0FBTyxNQUFNLEtBQUssSUFBSTtBQUN4QjtBQUdPLElBQU0sb0JBQW9CLENBQUMsY0FDaEMsZ0JBQWdCLFVBQVUsSUFBSSxDQUFDLEVBQUUsTUFBTSxNQUFNLE1BQU0sR0FBRyxJQUFJLE1BQU0sS0FBSyxVQUFVLEtBQUssQ0FBQyxFQUFFLEVBQUUsS0FBSyxJQUFJLENBQUM7QUFBQTtBQU05RixTQUFTLGlCQUFpQixNQUFNLE1BQU07QUFDM0MsUUFBTSxRQUFRLENBQUMsa0RBQWtELEVBQUU7QUFDbkUsYUFBVyxFQUFFLE1BQU0sTUFBTSxJQUFJLEtBQUssY0FBYyxNQUFNLElBQUksR0FBRztBQUMzRCxVQUFNLE9BQU8sSUFBSSxNQUFNLElBQUk7QUFDM0IsUUFBSSxRQUFRLE1BQU0sS0FBSyxXQUFXLEVBQUcsT0FBTSxLQUFLLE9BQU8sR0FBRyxLQUFLO0FBQUEsYUFDdEQsUUFBUSxHQUFJLE9BQU0sS0FBSyxPQUFPLEdBQUcsS0FBSyxJQUFJLENBQUMsU0FBUyxNQUFNLElBQUksR0FBRyxRQUFRLENBQUMsR0FBRyxLQUFLO0FBQzNGLFVBQU0sS0FBSyxnQkFBZ0IsSUFBSSxLQUFLLElBQUksR0FBRztBQUFBLEVBQzdDO0FBQ0EsU0FBTyxHQUFHLE1BQU0sS0FBSyxJQUFJLENBQUM7QUFBQTtBQUFBO0FBQUE7QUFBQTtBQUM1QjtBQUdPLElBQU0sa0JBQWtCLENBQUMsU0FBUyxHQUFHLElBQUk7QUFHekMsU0FBUyxjQUFjLE1BQU07QUFDbEMsU0FBTyxZQUFZLEtBQUssTUFBTSxVQUFVLENBQUMsRUFDdEMsSUFBSSxDQUFDLFNBQVMsS0FBSyxNQUFNLFlBQVksTUFBTSxLQUFLLENBQUMsRUFDakQsT0FBTyxDQUFDLFdBQVcsV0FBVyxNQUFNLENBQUMsRUFDckMsUUFBUSxDQUFDLFdBQVcsWUFBWSxRQUFRLEVBQUUsV0FBVyxNQUFNLFVBQVUsT0FBTyxDQUFDLEVBQUUsSUFBSSxDQUFDLFNBQVMsS0FBSyxRQUFRLElBQUksQ0FBQyxDQUFDLEVBQ2hILE9BQU8sQ0FBQyxTQUFTLEtBQUssU0FBUyxPQUFPLEtBQUssY0FBYyxhQUFhLE1BQU0sTUFBTSxHQUFHLElBQUksTUFBTSxNQUFTLEVBQ3hHLEtBQUs7QUFDVjtBQUVBLElBQUksUUFBUSxLQUFLLENBQUMsTUFBTSxjQUFjLHdDQUFlLEdBQUc7QUFDdEQsUUFBTSxPQUFPLEtBQUssa0NBQXFCLE9BQU87QUFDOUMsYUFBVyxRQUFRLGNBQWMsSUFBSSxHQUFHO0FBQ3RDLGtCQUFjLGdCQUFnQixJQUFJLEdBQUcsaUJBQWlCLGFBQWEsTUFBTSxNQUFNLEdBQUcsSUFBSSxDQUFDO0FBQ3ZGLFlBQVEsT0FBTyxNQUFNLEdBQUcsU0FBUyxNQUFNLGdCQUFnQixJQUFJLENBQUMsQ0FBQztBQUFBLENBQUk7QUFBQSxFQUNuRTtBQUNGOzs7QUUvTkEsSUFBTSxXQUFXLG9CQUFJLElBQUksQ0FBQyxLQUFLLE1BQU0sTUFBTSxNQUFNLE1BQU0sTUFBTSxJQUFJLENBQUM7QUFHbEUsVUFBVSxhQUFhO0FBQ3JCLFFBQU0sVUFBVTtBQUNoQixhQUFXLFVBQVUsUUFBUyxPQUFNO0FBQ3BDLGFBQVcsU0FBUyxRQUFTLFlBQVcsVUFBVSxRQUFTLE9BQU0sUUFBUTtBQUMzRTtBQU1PLFNBQVMsY0FBYyxRQUFRO0FBQ3BDLFFBQU0sUUFBUSxDQUFDO0FBQ2YsUUFBTSxjQUFjLElBQUksSUFBSSxPQUFPLElBQUksQ0FBQyxFQUFFLE1BQUFDLE1BQUssTUFBTUEsS0FBSSxDQUFDO0FBQzFELFFBQU0sT0FBTyxDQUFDQyxPQUFNLE9BQU9BLEVBQUMsR0FBRztBQUMvQixNQUFJLElBQUk7QUFHUixRQUFNLGVBQWUsQ0FBQyxPQUFPO0FBQzNCLFFBQUksUUFBUTtBQUNaLE9BQUc7QUFDRCxVQUFJLE1BQU0sU0FBUyxLQUFLLEVBQUUsQ0FBQyxFQUFHO0FBQzlCLFVBQUksTUFBTSxTQUFTLEtBQUssRUFBRSxDQUFDLEVBQUc7QUFDOUI7QUFBQSxJQUNGLFNBQVMsUUFBUSxLQUFLLEtBQUssT0FBTztBQUNsQyxXQUFPO0FBQUEsRUFDVDtBQUVBLFFBQU0sYUFBYSxNQUFNO0FBQ3ZCLFVBQU0sUUFBUSxvQkFBSSxJQUFJO0FBQ3RCLFVBQU0sYUFBYSxXQUFXO0FBQzlCLFVBQU0sV0FBVyxDQUFDLFNBQVM7QUFDekIsVUFBSSxRQUFRLE1BQU0sSUFBSSxJQUFJO0FBQzFCLGFBQU8sVUFBVSxRQUFXO0FBQzFCLGNBQU0sRUFBRSxNQUFNLElBQUksV0FBVyxLQUFLO0FBQ2xDLFlBQUksVUFBVSxPQUFXLFNBQVE7QUFBQSxpQkFDeEIsQ0FBQyxZQUFZLElBQUksS0FBSyxLQUFLLENBQUMsU0FBUyxJQUFJLEtBQUssRUFBRyxTQUFRO0FBQUEsTUFDcEU7QUFDQSxZQUFNLElBQUksTUFBTSxLQUFLO0FBQ3JCLGFBQU87QUFBQSxJQUNUO0FBRUEsVUFBTSxTQUFTLENBQUMsb0JBQUksSUFBSSxDQUFDO0FBQ3pCLFVBQU0sVUFBVSxDQUFDLFNBQVMsT0FBTyxHQUFHLEVBQUUsRUFBRSxJQUFJLElBQUk7QUFDaEQsVUFBTSxVQUFVLENBQUMsT0FBTztBQUN0QixZQUFNLEVBQUUsTUFBTSxNQUFNLE1BQU0sR0FBRyxJQUFJLE9BQU8sRUFBRTtBQUMxQyxZQUFNLFFBQVEsU0FBUyxJQUFJO0FBQzNCLFVBQUksTUFBTSxTQUFTLEtBQUssT0FBUSxPQUFNLEtBQUssRUFBRSxNQUFNLElBQUksTUFBTSxNQUFNLENBQUM7QUFBQSxJQUN0RTtBQUVBLFVBQU0sZ0JBQWdCLE1BQU07QUFDMUIsV0FBSztBQUNMLFVBQUksS0FBSyxDQUFDLE1BQU0sSUFBSyxLQUFJLGFBQWEsQ0FBQztBQUFBLElBQ3pDO0FBRUEsU0FBSztBQUVMLGFBQVNDLFNBQVEsT0FBTTtBQUNyQixZQUFNLFFBQVEsS0FBSyxDQUFDO0FBQ3BCLFVBQUksVUFBVSxLQUFLO0FBQ2pCLHNCQUFjO0FBQ2Q7QUFBQSxNQUNGO0FBQ0EsVUFBSSxVQUFVLE9BQU8sVUFBVSxJQUFLLENBQUFBO0FBQ3BDLFVBQUksVUFBVSxPQUFPLFVBQVUsSUFBSyxDQUFBQTtBQUNwQyxVQUFJQSxXQUFVLEtBQUssS0FBSyxJQUFJLENBQUMsTUFBTSxPQUFPLGFBQWEsS0FBSyxLQUFLLEdBQUc7QUFDbEUsZ0JBQVEsS0FBSztBQUNiLGdCQUFRLENBQUM7QUFBQSxNQUNYO0FBQ0E7QUFDQSxVQUFJQSxXQUFVLEVBQUc7QUFBQSxJQUNuQjtBQUNBLFdBQU8sS0FBSyxDQUFDLE1BQU0sSUFBSyxNQUFLO0FBRzdCLFFBQUksVUFBVSxDQUFDO0FBRWYsVUFBTSxRQUFRLENBQUM7QUFDZixRQUFJLFFBQVE7QUFDWixVQUFNLFNBQVMsTUFBTTtBQUNuQixjQUFRLFFBQVEsT0FBTztBQUN2QixnQkFBVSxDQUFDO0FBQUEsSUFDYjtBQUNBLFFBQUksUUFBUTtBQUNaLE9BQUc7QUFDRCxZQUFNLFFBQVEsS0FBSyxDQUFDO0FBQ3BCLFVBQUksVUFBVSxLQUFLO0FBQ2pCLHNCQUFjO0FBQ2Q7QUFBQSxNQUNGO0FBQ0EsVUFBSSxVQUFVLE9BQU87QUFDbkIsZUFBTyxLQUFLLG9CQUFJLElBQUksQ0FBQztBQUNyQixjQUFNLEtBQUssRUFBRSxPQUFPLE1BQU0sQ0FBQztBQUFBLE1BQzdCLFdBQVcsVUFBVSxJQUFLO0FBQUEsZUFDakIsVUFBVSxJQUFLO0FBQUEsZUFDZixVQUFVLElBQUssUUFBTztBQUFBLGVBQ3RCLFVBQVUsS0FBSztBQUN0QixlQUFPO0FBQ1A7QUFDQSxlQUFPLEtBQUssb0JBQUksSUFBSSxDQUFDO0FBQUEsTUFDdkIsV0FBVyxVQUFVLEtBQUs7QUFDeEIsZUFBTztBQUNQO0FBQ0EsZUFBTyxJQUFJO0FBQ1gsWUFBSSxNQUFNLEdBQUcsRUFBRSxHQUFHLFVBQVUsU0FBUyxNQUFNLEdBQUcsRUFBRSxFQUFFLFVBQVUsT0FBTztBQUNqRSxnQkFBTSxJQUFJO0FBQ1YsaUJBQU8sSUFBSTtBQUFBLFFBQ2I7QUFBQSxNQUNGLFdBQVcsb0JBQW9CLEtBQUssS0FBSyxHQUFHO0FBQzFDLFlBQUksS0FBSyxJQUFJO0FBQ2IsWUFBSSxLQUFLLEVBQUUsTUFBTSxJQUFLLFFBQU8sS0FBSyxJQUFJLE1BQU0sSUFBSTtBQUNoRCxnQkFBUSxLQUFLLEtBQUssRUFBRSxDQUFDO0FBRXJCLGdCQUFRLEVBQUU7QUFDVixZQUFJO0FBQUEsTUFDTixXQUFXLGFBQWEsS0FBSyxLQUFLLEtBQUssS0FBSyxJQUFJLENBQUMsTUFBTSxPQUFPLE9BQU8sS0FBSyxDQUFDLFVBQVUsTUFBTSxJQUFJLEtBQUssQ0FBQztBQUNuRyxnQkFBUSxDQUFDO0FBQ1g7QUFBQSxJQUNGLFNBQVMsUUFBUTtBQUFBLEVBQ25CO0FBRUEsU0FBTyxJQUFJLE9BQU8sUUFBUTtBQUN4QixRQUFJLEtBQUssQ0FBQyxNQUFNLEtBQU0sWUFBVztBQUFBLFFBQzVCO0FBQUEsRUFDUDtBQUNBLFNBQU87QUFDVDs7O0FIdEhBLElBQU0sVUFBVSxFQUFFLEtBQUssS0FBSyxLQUFLLEtBQUssS0FBSyxLQUFLLEtBQUssSUFBSTtBQVlsRCxTQUFTLFVBQVUsTUFBTSxPQUFPLGVBQWU7QUFDcEQsUUFBTSxPQUFPLENBQUMsSUFBSSxZQUFZO0FBQzVCLFVBQU0sSUFBSSxVQUFVLEdBQUcsSUFBSSxJQUFJLEtBQUssTUFBTSxHQUFHLEVBQUUsRUFBRSxNQUFNLElBQUksRUFBRSxNQUFNLEtBQUssT0FBTyxHQUFHO0FBQUEsRUFDcEY7QUFDQSxRQUFNLEVBQUUsUUFBUSxTQUFTLElBQUksU0FBUyxNQUFNLElBQUk7QUFDaEQsUUFBTSxVQUFVLENBQUM7QUFDakIsUUFBTSxRQUFRLENBQUM7QUFDZixNQUFJLE9BQU87QUFDWCxRQUFNLE9BQU8sTUFBTSxPQUFPLElBQUksR0FBRztBQUNqQyxRQUFNLE9BQU8sTUFBTSxPQUFPLElBQUksR0FBRyxRQUFRLEtBQUs7QUFDOUMsUUFBTSxPQUFPLENBQUMsYUFBYTtBQUN6QixVQUFNLFFBQVEsT0FBTyxJQUFJO0FBQ3pCLFFBQUksQ0FBQyxNQUFPLFFBQU8sS0FBSyxLQUFLLFFBQVEsV0FBVyxJQUFJLFFBQVEsNEJBQTRCLHdCQUF3QjtBQUNoSCxRQUFJLGFBQWEsVUFBYSxNQUFNLFNBQVM7QUFDM0MsV0FBSyxNQUFNLE1BQU0sSUFBSSxNQUFNLElBQUksbUJBQW1CLFFBQVEsZUFBZTtBQUMzRTtBQUNBLFdBQU87QUFBQSxFQUNUO0FBQ0EsUUFBTSxZQUFZLE1BQU0sT0FBTyxPQUFPLENBQUMsRUFBRTtBQUd6QyxRQUFNLGNBQWMsTUFBTTtBQUN4QixVQUFNLE9BQU8sS0FBSztBQUNsQixlQUFXLFFBQVEsUUFBUSxLQUFLLElBQUksR0FBRyxLQUFLLE1BQU0sUUFBUSxXQUFVO0FBQ3BFLFNBQUs7QUFBQSxFQUNQO0FBQ0EsUUFBTSxZQUFZLE1BQU07QUFDdEIsUUFBSSxLQUFLLE1BQU0sT0FBVyxNQUFLLEtBQUssUUFBUSxtQ0FBbUM7QUFDL0UsUUFBSSxLQUFLLE1BQU0sT0FBTyxtQkFBbUIsS0FBSyxPQUFPLE9BQU8sQ0FBQyxHQUFHLFFBQVEsRUFBRTtBQUN4RTtBQUFBLFFBQ0UsS0FBSztBQUFBLFFBQ0wsSUFBSSxPQUFPLE9BQU8sQ0FBQyxFQUFFLElBQUk7QUFBQSxNQUMzQjtBQUNGLFFBQUksS0FBSyxLQUFLLFdBQVcsS0FBSyxNQUFNLElBQUssYUFBWTtBQUFBLFFBQ2hELE1BQUs7QUFBQSxFQUNaO0FBQ0EsUUFBTSxTQUFTLElBQUksU0FBUztBQUMxQixXQUFPLENBQUMsS0FBSyxTQUFTLEtBQUssQ0FBQyxFQUFHLFdBQVU7QUFBQSxFQUMzQztBQUdBLFFBQU0sWUFBWSxNQUFNO0FBQ3RCLFVBQU0sT0FBTyxLQUFLLEdBQUcsRUFBRTtBQUN2QixVQUFNLFFBQVEsQ0FBQztBQUNmLE9BQUc7QUFDRCxVQUFJLE1BQU0sU0FBUyxFQUFHLE1BQUssSUFBSTtBQUMvQixVQUFJLFVBQVU7QUFDZCxhQUFPLEtBQUssTUFBTSxLQUFLO0FBQ3JCLGFBQUs7QUFDTCxrQkFBVSxDQUFDO0FBQUEsTUFDYjtBQUNBLFlBQU0sT0FBTyxLQUFLO0FBQ2xCLFVBQUksQ0FBQyxpQkFBaUIsS0FBSyxLQUFLLElBQUk7QUFDbEM7QUFBQSxVQUNFLEtBQUs7QUFBQSxVQUNMO0FBQUEsUUFDRjtBQUNGLFlBQU0sS0FBSyxHQUFHLFVBQVUsTUFBTSxFQUFFLEdBQUcsS0FBSyxJQUFJLEVBQUU7QUFBQSxJQUNoRCxTQUFTLEtBQUssTUFBTTtBQUNwQixRQUFJLEtBQUssTUFBTTtBQUNiO0FBQUEsUUFDRTtBQUFBLFFBQ0E7QUFBQSxNQUNGO0FBQ0YsU0FBSyxHQUFHO0FBQ1IsV0FBTyxNQUFNLEtBQUssSUFBSTtBQUFBLEVBQ3hCO0FBR0EsUUFBTSxhQUFhLE1BQU07QUFDdkIsUUFBSTtBQUNKLFdBQU8sS0FBSyxNQUFNLEtBQUs7QUFDckIsWUFBTSxFQUFFLEtBQUssSUFBSSxLQUFLLEdBQUc7QUFDekIsWUFBTSxPQUFPLEtBQUs7QUFDbEIsVUFBSSxtQkFBbUIsS0FBSyxLQUFLLElBQUksR0FBRztBQUN0QyxZQUFJLEtBQU0sTUFBSyxNQUFNLGdEQUFnRDtBQUNyRSxlQUFPLEVBQUUsTUFBTSxLQUFLLE1BQU0sTUFBTSxXQUFXLEtBQUssU0FBUyxTQUFTLFNBQVksVUFBVSxHQUFHLElBQUksRUFBRTtBQUNqRyxhQUFLLEtBQUssVUFBVTtBQUFBLE1BQ3RCLFdBQVcsS0FBSyxNQUFNLElBQUssYUFBWTtBQUFBLElBQ3pDO0FBQ0EsV0FBTztBQUFBLEVBQ1Q7QUFFQSxRQUFNLGFBQWEsQ0FBQyxTQUFTO0FBQzNCLFVBQU0sUUFBUSxDQUFDO0FBQ2YsVUFBTSxTQUFTLENBQUMsV0FBVztBQUN6QixVQUFJLEtBQUssTUFBTSxLQUFLO0FBQ2xCLGFBQUssR0FBRztBQUNSLGVBQU8sS0FBSyxNQUFNLEtBQUs7QUFDckIsaUJBQU8sTUFBTTtBQUNiLGNBQUksS0FBSyxNQUFNLElBQUssTUFBSyxHQUFHO0FBQUEsUUFDOUI7QUFDQSxhQUFLLEdBQUc7QUFDUjtBQUFBLE1BQ0Y7QUFDQSxZQUFNLE9BQU8sS0FBSztBQUNsQixVQUFJLENBQUMsaUJBQWlCLEtBQUssS0FBSyxJQUFJLEVBQUcsTUFBSyxLQUFLLE1BQU0sSUFBSSxLQUFLLElBQUksd0JBQXdCO0FBQzVGLFVBQUksS0FBSyxNQUFNLE1BQU07QUFDbkIsYUFBSyxJQUFJO0FBQ1QsZUFBTyxDQUFDLEdBQUcsUUFBUSxLQUFLLElBQUksQ0FBQztBQUFBLE1BQy9CLFdBQVcsS0FBSyxNQUFNLEtBQU0sTUFBSyxLQUFLLEdBQUcsbUVBQW1FO0FBQUEsVUFDdkcsT0FBTSxLQUFLLEVBQUUsTUFBTSxRQUFRLE1BQU0sS0FBSyxNQUFNLElBQUksS0FBSyxLQUFLLENBQUM7QUFBQSxJQUNsRTtBQUNBLFdBQU8sSUFBSTtBQUNYLFdBQU87QUFBQSxFQUNUO0FBRUEsUUFBTSxrQkFBa0IsQ0FBQyxNQUFNLFNBQVM7QUFDdEMsUUFBSSxTQUFTLEtBQUssU0FBUyxRQUFRLEtBQUssVUFBVSxTQUFTLEdBQUc7QUFDNUQsV0FBSyxNQUFNLCtDQUErQztBQUM1RCxTQUFLLFFBQVE7QUFDYixlQUFXLEVBQUUsTUFBTSxNQUFNLEdBQUcsS0FBSyxXQUFXLENBQUMsQ0FBQyxHQUFHO0FBQy9DLFVBQUksS0FBSyxXQUFXLEVBQUcsTUFBSyxJQUFJLFdBQVcsSUFBSSxtQkFBbUI7QUFDbEUsY0FBUSxLQUFLLEVBQUUsTUFBTSxNQUFNLE1BQU0sTUFBTSxXQUFXLE1BQU0sS0FBSyxNQUFNLEdBQUcsRUFBRSxFQUFFLE1BQU0sSUFBSSxFQUFFLE9BQU8sQ0FBQztBQUFBLElBQ2hHO0FBQ0EsU0FBSyxHQUFHO0FBRVIsVUFBTSxLQUFLLEVBQUUsTUFBTSxJQUFJLFVBQVUsR0FBRyxNQUFNLEtBQUssTUFBTSxNQUFNLFVBQVUsQ0FBQyxFQUFFLFFBQVEsV0FBVyxFQUFFLEVBQUUsQ0FBQztBQUFBLEVBQ2xHO0FBRUEsUUFBTSxRQUFRLE1BQU07QUFDbEIsU0FBSyxHQUFHO0FBQ1IsYUFBUyxXQUFXLEdBQUc7QUFDdkIsU0FBSyxHQUFHO0FBQUEsRUFDVjtBQUVBLFFBQU0sY0FBYyxNQUFNO0FBQ3hCLFFBQUksS0FBSyxNQUFNLE1BQU07QUFDbkIsV0FBSztBQUNMLFdBQUs7QUFDTCxXQUFLLEdBQUc7QUFDUixlQUFTLE9BQU8sR0FBRyxHQUFHLEdBQUc7QUFDekIsV0FBSyxHQUFHO0FBQ1IsYUFBTyxHQUFHO0FBQ1YsWUFBTTtBQUFBLElBQ1IsV0FBVyxLQUFLLE1BQU0sVUFBVTtBQUM5QixXQUFLO0FBQ0wsV0FBSztBQUNMLFdBQUssR0FBRztBQUNSLGVBQVMsT0FBTyxHQUFHLEdBQUcsR0FBRztBQUN6QixXQUFLLEdBQUc7QUFDUixVQUFJLEtBQUssTUFBTSxJQUFLLE1BQUs7QUFBQSxJQUMzQixPQUFPO0FBQ0wsVUFBSSxLQUFLLE1BQU0sSUFBSyxRQUFPLEdBQUc7QUFDOUIsV0FBSyxHQUFHO0FBQUEsSUFDVjtBQUFBLEVBQ0Y7QUFHQSxRQUFNLFNBQVMsQ0FBQyxVQUFVLE1BQU07QUFDOUIsUUFBSSxRQUFRO0FBQ1osV0FBTyxRQUFRLEtBQU0sS0FBSyxNQUFNLE9BQU8sS0FBSyxNQUFNLE9BQVE7QUFDeEQsVUFBSSxLQUFLLE1BQU0sSUFBSztBQUNwQixVQUFJLEtBQUssTUFBTSxJQUFLO0FBQ3BCLGdCQUFVO0FBQUEsSUFDWjtBQUNBLFFBQUksS0FBSyxNQUFNLElBQUssTUFBSztBQUFBLEVBQzNCO0FBRUEsUUFBTSxTQUFTLE1BQU07QUFDbkIsUUFBSSxLQUFLLE1BQU0sVUFBVSxLQUFLLE1BQU0sVUFBVyxNQUFLLEtBQUssR0FBRyxJQUFJLEtBQUssQ0FBQyxtQ0FBbUM7QUFDekcsV0FBTyxHQUFHO0FBQ1YsVUFBTTtBQUFBLEVBQ1I7QUFFQSxRQUFNLFlBQVksTUFBTTtBQUN0QixZQUFRLEtBQUssR0FBRztBQUFBLE1BQ2QsS0FBSztBQUNILGVBQU8sTUFBTTtBQUFBLE1BQ2YsS0FBSztBQUFBLE1BQ0wsS0FBSztBQUFBLE1BQ0wsS0FBSztBQUNILGFBQUs7QUFDTCxlQUFPLEdBQUc7QUFDVixjQUFNO0FBQ04sZUFBTyxLQUFLLE1BQU0sUUFBUTtBQUN4QixlQUFLO0FBQ0wsaUJBQU8sR0FBRztBQUNWLGdCQUFNO0FBQUEsUUFDUjtBQUNBLGVBQU87QUFBQSxNQUNULEtBQUs7QUFBQSxNQUNMLEtBQUs7QUFDSCxhQUFLO0FBQ0wsZUFBTyxHQUFHO0FBQ1YsZUFBTyxNQUFNO0FBQUEsTUFDZixLQUFLO0FBQ0gsYUFBSztBQUNMLGVBQU8sR0FBRztBQUNWLGFBQUssR0FBRztBQUNSLGlCQUFTLFFBQVEsR0FBRztBQUNwQixhQUFLLEdBQUc7QUFDUixlQUFPO0FBQUEsTUFDVDtBQUNFLGVBQU8sS0FBSyxHQUFHO0FBQ2YsYUFBSyxHQUFHO0FBQ1IsZUFBTztBQUFBLElBQ1g7QUFBQSxFQUNGO0FBR0EsUUFBTSxXQUFXLENBQUMsU0FBUyxVQUFVO0FBRW5DLFFBQUksT0FBTztBQUNYLFFBQUksTUFBTTtBQUNWLFFBQUk7QUFDSixVQUFNLGFBQWEsTUFBTTtBQUN2QixVQUFJLE9BQU87QUFDVCxjQUFNLEtBQUssRUFBRSxNQUFNLEtBQUssSUFBSSxLQUFLLE1BQU0sR0FBRyxXQUFXLE9BQU8sSUFBSSxDQUFDLEdBQUcsS0FBSyxLQUFLLEtBQUssR0FBRyxLQUFLLEVBQUUsSUFBSSxNQUFNLEVBQUUsR0FBRyxDQUFDO0FBQy9HLGFBQU87QUFDUCxjQUFRO0FBQUEsSUFDVjtBQUNBLFdBQU8sS0FBSyxNQUFNLE9BQU87QUFDdkIsVUFBSSxLQUFLLE1BQU0sT0FBVyxNQUFLLEtBQUssUUFBUSxJQUFJLEtBQUsseUJBQXlCO0FBQzlFLFlBQU0sT0FBTyxLQUFLO0FBQ2xCLFlBQU0sT0FBTyxXQUFXO0FBRXhCLFlBQU0sU0FBUyxNQUFNLFNBQVMsUUFBUSxLQUFLLGNBQWMsU0FBUyxLQUFLLE1BQU07QUFDN0UsV0FBSyxDQUFDLFFBQVEsS0FBSyxTQUFTLFNBQVMsQ0FBQyxPQUFRLFlBQVc7QUFDekQsVUFBSSxLQUFLLE1BQU0sWUFBWSxVQUFVLFFBQVc7QUFDOUMsd0JBQWdCLE1BQU0sSUFBSTtBQUMxQjtBQUFBLE1BQ0Y7QUFDQSxVQUFJLE1BQU07QUFDUixZQUFJLEtBQUssU0FBUyxRQUFRLFNBQVMsRUFBRyxNQUFLLEtBQUssTUFBTSxJQUFJLEtBQUssSUFBSSx3QkFBd0I7QUFDM0YsY0FBTSxRQUFRLEtBQUssU0FBUyxPQUFPLEtBQUs7QUFDeEMsY0FBTSxNQUFNLEtBQUssS0FBSyxLQUFLLEtBQUssRUFBRSxLQUFLLEdBQUcsSUFBSSxLQUFLO0FBQ25ELGNBQU0sUUFBUSxTQUFTLEtBQUssR0FBRyxLQUFLLEdBQUcsS0FBSyxjQUFjLFNBQVksS0FBSyxTQUFTLEtBQUssU0FBUyxFQUFFO0FBQ3BHLGNBQU0sS0FBSyxFQUFFLE1BQU0sS0FBSyxNQUFNLElBQUksS0FBSyxJQUFJLE1BQU0sR0FBRyxLQUFLLEdBQUcsR0FBRyxHQUFHLENBQUM7QUFDbkUsWUFBSSxLQUFLLGNBQWMsVUFBYSxDQUFDLE9BQVE7QUFDN0MsZ0JBQVEsS0FBSyxTQUFTLE9BQU8sS0FBSyxZQUFZO0FBQUEsTUFDaEQ7QUFDQSxjQUFRO0FBQ1IsWUFBTSxVQUFVO0FBQ2hCLFVBQUksTUFBTSxTQUFTLE9BQVEsWUFBVztBQUFBLElBQ3hDO0FBQ0EsZUFBVztBQUFBLEVBQ2I7QUFFQSxXQUFTLGFBQWEsTUFBUztBQUMvQixhQUFXLEVBQUUsTUFBTSxHQUFHLEtBQUs7QUFDekIsUUFBSSxLQUFLLE1BQU0sTUFBTSxFQUFFLEVBQUUsU0FBUyxLQUFLLEVBQUcsTUFBSyxNQUFNLGtEQUFrRDtBQUN6RyxTQUFPLEVBQUUsU0FBUyxPQUFPLFVBQVUsT0FBTztBQUM1QztBQUVBLElBQU0sV0FBVztBQU1WLFNBQVMsUUFBUSxNQUFNO0FBQzVCLE1BQUksS0FBSyxTQUFTLElBQUksRUFBRyxRQUFPO0FBQ2hDLFFBQU0sU0FBUyxLQUFLLFFBQVEsd0JBQXdCLENBQUMsUUFBUSxRQUFRLFVBQVU7QUFDN0UsVUFBTSxZQUFZLEtBQUssS0FBSyxNQUFNLEtBQUssS0FBSyxLQUFLLEtBQUs7QUFDdEQsV0FBTyxhQUFjLFNBQVMsS0FBSyxNQUFNLEtBQUssU0FBUyxLQUFLLEtBQUssSUFBSyxTQUFTO0FBQUEsRUFDakYsQ0FBQztBQUVELFNBQU8sT0FBTyxRQUFRLHlCQUF5QixFQUFFLEVBQUUsUUFBUSx3QkFBd0IsRUFBRTtBQUN2RjtBQUdBLElBQU0sZUFBZSxDQUFDLFNBQ3BCLEtBQ0csTUFBTSxrQ0FBa0MsRUFDeEMsSUFBSSxDQUFDLE1BQU0sTUFBTTtBQUNoQixNQUFJLElBQUksRUFBRyxRQUFPO0FBQ2xCLFFBQU0sT0FBTyxRQUFRLEtBQUssS0FBSyxDQUFDO0FBQ2hDLFNBQU8sSUFBSSxLQUFLLE1BQU0sS0FBSyxJQUFJLElBQUksSUFBSSxJQUFJLEtBQUs7QUFDbEQsQ0FBQyxFQUNBLEtBQUssRUFBRTtBQUVaLFNBQVMsTUFBTSxNQUFNLE9BQU87QUFDMUIsTUFBSSxTQUFTO0FBQ2IsYUFBVyxRQUFRLENBQUMsR0FBRyxLQUFLLEVBQUUsS0FBSyxDQUFDLEdBQUcsTUFBTSxFQUFFLE9BQU8sRUFBRSxRQUFRLEVBQUUsS0FBSyxFQUFFLEVBQUU7QUFDekUsYUFBUyxPQUFPLE1BQU0sR0FBRyxLQUFLLElBQUksSUFBSSxLQUFLLE9BQU8sT0FBTyxNQUFNLEtBQUssRUFBRTtBQUN4RSxTQUFPO0FBQ1Q7QUFNQSxTQUFTLFVBQVUsTUFBTSxFQUFFLE9BQU8sVUFBVSxPQUFPLEdBQUcsUUFBUTtBQUM1RCxNQUFJLENBQUMsT0FBUSxRQUFPLE1BQU0sTUFBTSxLQUFLO0FBQ3JDLFFBQU0sT0FBTyxNQUFNLE1BQU07QUFBQSxJQUN2QixHQUFHO0FBQUEsSUFDSCxHQUFHLGNBQWMsTUFBTTtBQUFBLElBQ3ZCLEdBQUcsU0FBUyxJQUFJLENBQUMsRUFBRSxNQUFNLEdBQUcsT0FBTyxFQUFFLE1BQU0sSUFBSSxNQUFNLEtBQUssTUFBTSxNQUFNLEVBQUUsRUFBRSxRQUFRLFdBQVcsRUFBRSxLQUFLLElBQUksRUFBRTtBQUFBLEVBQzVHLENBQUM7QUFDRCxTQUFPLEtBQUssTUFBTSxJQUFJLEVBQUUsSUFBSSxZQUFZLEVBQUUsS0FBSyxJQUFJO0FBQ3JEO0FBR0EsU0FBUyxVQUFVLE1BQU07QUFDdkIsV0FBUyxTQUFTLFFBQVEsSUFBSSxHQUFHLFdBQVcsUUFBUSxNQUFNLEdBQUcsU0FBUyxRQUFRLE1BQU0sR0FBRztBQUNyRixVQUFNLFdBQVdDLE1BQUssUUFBUSxjQUFjO0FBQzVDLFFBQUlDLFlBQVcsUUFBUTtBQUNyQixhQUFPLEVBQUUsUUFBUSxPQUFPLEtBQUssTUFBTUMsY0FBYSxVQUFVLE1BQU0sQ0FBQyxFQUFFLEtBQUssTUFBTSxHQUFHLEVBQUUsR0FBRyxFQUFFLEVBQUU7QUFBQSxFQUM5RjtBQUNBLFFBQU0sSUFBSSxVQUFVLEdBQUcsSUFBSSwwQkFBMEI7QUFDdkQ7QUFNQSxJQUFNLFdBQVcsQ0FBQyxTQUFTLGdDQUFnQyxLQUFLLElBQUk7QUFHN0QsSUFBTSxTQUFTLENBQUMsU0FBUyxLQUFLLEdBQUcsRUFBRSxNQUFNO0FBT2hELFNBQVMsY0FBYyxFQUFFLE1BQU0sTUFBTSxLQUFLLEdBQUcsTUFBTSxRQUFRO0FBQ3pELFFBQU0sQ0FBQyxNQUFNLEdBQUcsSUFBSSxJQUFJO0FBQ3hCLFFBQU0sU0FBUyxTQUFTLFlBQVksU0FBUyxTQUFTLFVBQVUsUUFBUSxJQUFJLElBQUk7QUFDaEYsTUFBSSxXQUFXLE9BQVcsT0FBTSxJQUFJLFVBQVUsR0FBRyxJQUFJLElBQUksSUFBSSxNQUFNLElBQUksMkNBQTJDO0FBQ2xILFFBQU0sT0FBTyxRQUFRLFFBQVEsR0FBRyxJQUFJO0FBQ3BDLE1BQUlELFlBQVcsR0FBRyxJQUFJLE9BQU8sRUFBRyxRQUFPLEVBQUUsTUFBTSxHQUFHLElBQUksU0FBUyxNQUFNLEtBQUs7QUFDMUUsUUFBTSxhQUFhLEdBQUdELE1BQUssUUFBUSxJQUFJLElBQUksS0FBSyxHQUFHLEVBQUUsS0FBSyxJQUFJLFdBQVcsS0FBSyxHQUFHLENBQUMsQ0FBQztBQUNuRixNQUFJQyxZQUFXLFVBQVUsRUFBRyxRQUFPLEVBQUUsTUFBTSxZQUFZLE1BQU0sTUFBTTtBQUNuRSxRQUFNLElBQUk7QUFBQSxJQUNSLEdBQUcsSUFBSSxJQUFJLElBQUksd0JBQXdCLEtBQUssS0FBSyxJQUFJLENBQUMsY0FBYyxJQUFJLGtCQUFrQixJQUFJLGFBQWEsVUFBVTtBQUFBLEVBQ3ZIO0FBQ0Y7QUFlTyxTQUFTLFlBQVksTUFBTSxNQUFNLEVBQUUsU0FBUyxPQUFPLE9BQU8sTUFBTSxJQUFJLENBQUMsR0FBRztBQUM3RSxRQUFNLFNBQVMsVUFBVSxNQUFNLElBQUk7QUFDbkMsUUFBTSxFQUFFLFFBQVEsTUFBTSxJQUFJLFVBQVUsSUFBSTtBQUN4QyxRQUFNLFNBQVNELE1BQUssUUFBUSxLQUFLO0FBQ2pDLFFBQU0sUUFBUSxvQkFBSSxJQUFJO0FBQ3RCLFFBQU0sZUFBZSxvQkFBSSxJQUFJO0FBQzdCLFFBQU0sVUFBVSxvQkFBSSxJQUFJO0FBQ3hCLFFBQU0sT0FBTyxvQkFBSSxJQUFJLENBQUMsWUFBWSxDQUFDO0FBQ25DLE1BQUksVUFBVTtBQUNkLGFBQVcsU0FBUyxPQUFPLFNBQVM7QUFDbEMsUUFBSSxPQUFPLE1BQU0sSUFBSSxFQUFHO0FBQ3hCLFVBQU0sRUFBRSxNQUFNLFFBQVEsS0FBSyxJQUFJLGNBQWMsT0FBTyxNQUFNLE1BQU07QUFDaEUsVUFBTSxZQUFZLEtBQUtHLFVBQVMsUUFBUSxJQUFJLEdBQUcsTUFBTSxFQUFFLE1BQU0sR0FBRyxFQUFFLEtBQUssR0FBRyxDQUFDLEdBQ3hFLFFBQVEsZUFBZSxLQUFLLEVBQzVCLFFBQVEsU0FBUyxFQUFFO0FBQ3RCLFFBQUksQ0FBQyxRQUFRLFNBQVMsTUFBTSxJQUFJLEdBQUc7QUFDakMsVUFBSSxRQUFRLElBQUksTUFBTSxJQUFJLEVBQUc7QUFDN0IsY0FBUSxJQUFJLE1BQU0sTUFBTSxTQUFTLFFBQVEsSUFBSSxFQUFFO0FBQy9DLGlCQUFXLFlBQVksTUFBTSxJQUFJLE9BQU8sUUFBUSxJQUFJLE1BQU0sSUFBSSxDQUFDLFdBQVcsS0FBSyxVQUFVLFNBQVMsQ0FBQztBQUNuRztBQUFBLElBQ0Y7QUFDQSxVQUFNLE1BQU0sT0FBTyxZQUFZLEdBQUcsU0FBUyxJQUFJLE1BQU0sSUFBSTtBQUN6RCxRQUFJLE9BQU8sTUFBTSxJQUFJLEdBQUc7QUFDeEIsUUFBSSxTQUFTLFFBQVc7QUFDdEIsWUFBTSxJQUFJLEtBQU0sT0FBTyxTQUFTLE1BQU0sSUFBSSxFQUFHO0FBQzdDLGlCQUFXLFVBQVUsT0FBTyxPQUFPLEtBQUssTUFBTSxJQUFJLE9BQU8sSUFBSSxJQUFJLFNBQVMsS0FBSyxVQUFVLFNBQVMsQ0FBQztBQUFBLElBQ3JHO0FBQ0EsUUFBSSxNQUFNLFNBQVMsT0FBVyxNQUFLLElBQUksT0FBTztBQUM5QyxVQUFNLGFBQ0osTUFBTSxTQUFTLFNBQVksT0FBTyx5QkFBeUIsS0FBSyxVQUFVLE1BQU0sSUFBSSxDQUFDLEtBQUssSUFBSTtBQUNoRyxpQkFBYSxJQUFJLFlBQVksVUFBVTtBQUFBLEVBQ3pDO0FBQ0EsUUFBTSxRQUFRLEdBQUcsS0FBSyxJQUFJLEtBQ3ZCLE1BQU0sT0FBTyxFQUNiLEdBQUcsRUFBRSxFQUNMLFFBQVEsV0FBVyxFQUFFLEVBQ3JCLFdBQVcsS0FBSyxHQUFHLENBQUM7QUFDdkIsUUFBTSxRQUFRLFVBQVUsTUFBTSxRQUFRLFVBQVUsSUFBSTtBQUNwRCxRQUFNLFlBQVksT0FBTyxNQUFNLFFBQVEsVUFBVSxJQUFJLEVBQUUsVUFBVSxJQUFJLE9BQ2xFLFFBQVEsbUJBQW1CLE1BQU0sRUFDakMsUUFBUSxpQkFBaUIsQ0FBQyxTQUFVLFFBQVEsSUFBSSxJQUFJLElBQUksTUFBTSxRQUFRLElBQUksSUFBSSxDQUFDLE9BQU8sSUFBSztBQUU5RixRQUFNLE9BQU8sWUFBWSxDQUFDLEdBQUcsSUFBSSxFQUFFLEtBQUssRUFBRSxLQUFLLElBQUksQ0FBQyxnQ0FBZ0MsT0FBTyw2Q0FBNkMsS0FBSyxVQUFVLEtBQUssQ0FBQyxPQUFPLFFBQVEsS0FBSyxhQUFhLE9BQU8sSUFBSSxNQUFNLENBQUMsR0FBRyxhQUFhLE9BQU8sQ0FBQyxFQUFFLEtBQUssSUFBSSxDQUFDLE1BQU0sRUFBRTtBQUFBO0FBQzVQLFFBQU0sWUFBWSxjQUFjLE1BQU0sSUFBSTtBQUMxQyxRQUFNLFdBQVcsT0FBTyxRQUFRLE9BQU8sS0FBSyxNQUFNLElBQUksRUFBRSxTQUFTLENBQUMsQ0FBQztBQUNuRSxTQUFPO0FBQUEsSUFDTCxNQUFNLFlBQVksT0FBTyxrQkFBa0IsU0FBUyxJQUFJO0FBQUEsSUFDeEQsS0FBSyxFQUFFLFNBQVMsR0FBRyxTQUFTLENBQUMsS0FBSyxNQUFNLE9BQU8sRUFBRSxHQUFHLEVBQUUsQ0FBQyxHQUFHLGdCQUFnQixDQUFDLElBQUksR0FBRyxPQUFPLENBQUMsR0FBRyxTQUFTO0FBQUEsRUFDeEc7QUFDRjtBQUdPLElBQU0sYUFBYSxDQUFDLFVBQVUsQ0FBQyxPQUFPO0FBQUEsRUFDM0MsTUFBTTtBQUFBLEVBQ04sTUFBTUMsUUFBTztBQUNYLElBQUFBLE9BQU0sT0FBTyxFQUFFLFFBQVEsVUFBVSxHQUFHLENBQUMsRUFBRSxLQUFLLE1BQU07QUFDaEQsWUFBTSxFQUFFLE1BQU0sSUFBSSxJQUFJLFlBQVlGLGNBQWEsTUFBTSxNQUFNLEdBQUcsTUFBTSxPQUFPO0FBQzNFLGFBQU87QUFBQSxRQUNMLFVBQVUsR0FBRyxJQUFJLHFEQUFxRCxPQUFPLEtBQUssS0FBSyxVQUFVLEdBQUcsQ0FBQyxFQUFFLFNBQVMsUUFBUSxDQUFDO0FBQUEsUUFDekgsUUFBUTtBQUFBLFFBQ1IsWUFBWSxRQUFRLElBQUk7QUFBQSxNQUMxQjtBQUFBLElBQ0YsQ0FBQztBQUFBLEVBQ0g7QUFDRjs7O0FEbGJ3SixJQUFNRyw0Q0FBMkM7QUFVek0sZUFBc0IsV0FBVyxXQUFtQixNQUFnQztBQUNsRixRQUFNLEVBQUUsWUFBWSxJQUFJLE1BQU0sTUFBTTtBQUFBLElBQ2xDLE9BQU87QUFBQSxNQUNMLFVBQVUsWUFBWSxJQUFJLHFCQUFxQixTQUFTO0FBQUEsTUFDeEQsWUFBWUMsZUFBYyxJQUFJLElBQUksS0FBS0QseUNBQWUsQ0FBQztBQUFBLElBQ3pEO0FBQUEsSUFDQSxZQUFZLENBQUMsZUFBZTtBQUFBLElBQzVCLFFBQVE7QUFBQSxJQUNSLFFBQVE7QUFBQSxJQUNSLFVBQVU7QUFBQSxJQUNWLFNBQVMsQ0FBQyxXQUFXLENBQUM7QUFBQSxJQUN0QixPQUFPO0FBQUEsRUFDVCxDQUFDO0FBQ0QsUUFBTSxFQUFFLE1BQU0sSUFBSyxNQUFNLE9BQ3ZCLCtCQUErQixPQUFPLEtBQUssWUFBWSxDQUFDLEVBQUcsUUFBUSxFQUFFLFNBQVMsUUFBUSxDQUFDO0FBRXpGLFNBQU87QUFDVDs7O0FEcEJBLElBQU8sNEJBQVEsYUFBYTtBQUFBLEVBQzFCLE9BQU8sQ0FBQyxvREFBb0Qsb0RBQW9EO0FBQUEsRUFDaEgsTUFBTSxZQUE4QixNQUFNLFdBQVcscUNBQXFDLE1BQU07QUFDbEcsQ0FBQzsiLAogICJuYW1lcyI6IFsiZmlsZVVSTFRvUGF0aCIsICJleGlzdHNTeW5jIiwgInJlYWRGaWxlU3luYyIsICJqb2luIiwgInJlbGF0aXZlIiwgInRleHQiLCAiaSIsICJkZXB0aCIsICJqb2luIiwgImV4aXN0c1N5bmMiLCAicmVhZEZpbGVTeW5jIiwgInJlbGF0aXZlIiwgImJ1aWxkIiwgIl9fdml0ZV9pbmplY3RlZF9vcmlnaW5hbF9pbXBvcnRfbWV0YV91cmwiLCAiZmlsZVVSTFRvUGF0aCJdCn0K
