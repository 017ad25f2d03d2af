// What our packages publish, as a plugin of esbuild for their builds, and of Vite for pages that are made from their
// sources.
//
// 1. It marks for bundlers which top-level constants may be dropped. `const coat = wgslModule(…, [other.module])` looks
// like
//    a side effect: a call, and a property read in its arguments. `sideEffects: false` helps only across files, and an
//    entry here is one file with its chunks. So each computed initializer becomes `/* @__PURE__ */ (() => …)()`, which
//    esbuild, Rollup, webpack and terser drop when nobody uses the constant. It is honest because importing a module
//    of ours does nothing, which tools/check-entries.mjs tests.
// 2. It takes comments, indentation and the spaces around operators out of WGSL templates, which no minifier looks
// into.
//    Line breaks stay, so that errors still name the line of the source. `.wesl` files become modules likewise.
import { readFile } from 'node:fs/promises';
import ts from 'typescript';
import { closeUp, weslSource } from './wesl.mjs';

/** True unless the expression is plainly a value: literals, names, functions, and arrays or objects of them. */
function computes(node) {
  if (ts.isFunctionLike(node) || ts.isIdentifier(node) || ts.isLiteralExpression(node) || ts.isTypeNode(node))
    return false;
  if (
    node.kind === ts.SyntaxKind.TrueKeyword ||
    node.kind === ts.SyntaxKind.FalseKeyword ||
    node.kind === ts.SyntaxKind.NullKeyword
  )
    return false;
  if (ts.isPrefixUnaryExpression(node)) return !ts.isNumericLiteral(node.operand);
  if (
    ts.isParenthesizedExpression(node) ||
    ts.isAsExpression(node) ||
    ts.isSatisfiesExpression(node) ||
    ts.isNonNullExpression(node)
  )
    return computes(node.expression);
  if (ts.isArrayLiteralExpression(node)) return node.elements.some(computes);
  if (ts.isObjectLiteralExpression(node)) {
    return node.properties.some((property) => {
      if (ts.isShorthandPropertyAssignment(property)) return false;
      if (property.name === undefined || ts.isComputedPropertyName(property.name)) return true;
      return ts.isPropertyAssignment(property) ? computes(property.initializer) : false;
    });
  }
  return true;
}

const isWgsl = (node, source) =>
  /\/\*\s*wgsl\s*\*\/\s*$/.test(source.text.slice(node.getFullStart(), node.getStart(source)));

/** One literal piece of a WGSL template. A comment that runs on into a substitution is left alone. */
function shrinkPiece(text, continues, goesOn) {
  const lines = text.split('\n');
  return lines
    .map((line, i) => {
      if (i === 0 && continues) return line;
      const runsOn = goesOn && i === lines.length - 1;
      const bare = runsOn ? line : line.replace(/(?<!\/)\/\/(?!#).*$/, '').trimEnd();
      return closeUp(bare.trimStart());
    })
    .join('\n');
}

/** Edits that shrink every WGSL template of the file. */
function wgslEdits(source) {
  const edits = [];
  const piece = (node, head, tail, continues, goesOn) => {
    const from = node.getStart(source) + head;
    const to = node.end - tail;
    const text = source.text.slice(from, to);
    // Block comments may span pieces; such a template keeps its text.
    if (!text.includes('/*')) edits.push({ from, to, text: shrinkPiece(text, continues, goesOn) });
  };
  const visit = (node) => {
    if (ts.isNoSubstitutionTemplateLiteral(node) && isWgsl(node, source)) piece(node, 1, 1, false, false);
    else if (ts.isTemplateExpression(node) && isWgsl(node, source)) {
      piece(node.head, 1, 2, false, true);
      node.templateSpans.forEach(({ literal }, i) =>
        piece(literal, 1, i === node.templateSpans.length - 1 ? 1 : 2, true, i < node.templateSpans.length - 1),
      );
      node.templateSpans.forEach(({ expression }) => visit(expression));
    } else ts.forEachChild(node, visit);
  };
  visit(source);
  return edits;
}

/** Insertions that make the computed initializers of top-level constants droppable. */
function pureEdits(source) {
  const edits = [];
  for (const statement of source.statements) {
    if (!ts.isVariableStatement(statement) || !(statement.declarationList.flags & ts.NodeFlags.Const)) continue;
    for (const { initializer, name } of statement.declarationList.declarations) {
      // A destructured constant reads properties at its own place; leave it be.
      if (!initializer || !ts.isIdentifier(name) || !computes(initializer)) continue;
      const from = initializer.getStart(source);
      edits.push(
        { from, to: from, text: '/* @__PURE__ */ (() => (' },
        { from: initializer.end, to: initializer.end, text: '))()' },
      );
    }
  }
  return edits;
}

/** What of a source file is published. @param {string} text @returns {string} */
export function preparePublished(text, fileName = 'module.ts') {
  const source = ts.createSourceFile(fileName, text, ts.ScriptTarget.Latest, true);
  const edits = [...pureEdits(source), ...wgslEdits(source)].sort((a, b) => b.from - a.from || b.to - a.to);
  let result = text;
  for (const edit of edits) result = result.slice(0, edit.from) + edit.text + result.slice(edit.to);
  return result;
}

export const publishedSource = {
  name: 'published-source',
  setup(build) {
    weslSource({ shrink: true }).setup(build);
    build.onLoad({ filter: /[\\/]src[\\/].*\.ts$/ }, async ({ path }) => ({
      contents: preparePublished(await readFile(path, 'utf8'), path),
      loader: 'ts',
    }));
  },
};

/** The same for pages: in builds only, so that what a developer looks at in the browser is the source. */
export const publishedModules = () => ({
  name: 'published-source',
  apply: 'build',
  enforce: 'pre',
  transform: (code, id) =>
    /[\\/]packages[\\/][^\\/]+[\\/]src[\\/].*\.ts$/.test(id)
      ? { code: preparePublished(code, id), map: null }
      : undefined,
});
