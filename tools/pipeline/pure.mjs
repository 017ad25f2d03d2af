// An esbuild plugin that tells bundlers which top-level constants may be dropped.
//
// `const coat = wgslModule(…, [other.module])` looks like a side effect to a bundler: a call, and a property read in its
// arguments. `sideEffects: false` helps only across files, and every entry here is one file with its chunks. So each such
// initializer becomes `/* @__PURE__ */ (() => …)()`, which esbuild, Rollup, webpack and terser drop when nobody uses the
// constant. It is honest because importing a module of ours does nothing, which tools/check-entries.mjs tests.
import { readFile } from 'node:fs/promises';
import ts from 'typescript';

/** True if evaluating the expression runs code or reads properties; bodies of functions inside do not count. */
function computes(node) {
  if (ts.isFunctionLike(node)) return false;
  if (ts.isCallExpression(node) || ts.isNewExpression(node) || ts.isPropertyAccessExpression(node) || ts.isElementAccessExpression(node) || ts.isSpreadElement(node) || ts.isSpreadAssignment(node) || ts.isTemplateExpression(node)) return true;
  return ts.forEachChild(node, (child) => computes(child) || undefined) ?? false;
}

/** Wraps the computed initializers of a module's top-level constants. @param {string} text @returns {string} */
export function annotatePure(text, fileName = 'module.ts') {
  const source = ts.createSourceFile(fileName, text, ts.ScriptTarget.Latest, true);
  const edits = [];
  for (const statement of source.statements) {
    if (!ts.isVariableStatement(statement) || !(statement.declarationList.flags & ts.NodeFlags.Const)) continue;
    for (const { initializer, name } of statement.declarationList.declarations) {
      // A destructured constant reads properties at its own place; leave it be.
      if (initializer && ts.isIdentifier(name) && computes(initializer)) edits.push({ from: initializer.getStart(source), to: initializer.end });
    }
  }
  let result = text;
  for (const { from, to } of edits.reverse()) result = `${result.slice(0, from)}/* @__PURE__ */ (() => (${result.slice(from, to)}))()${result.slice(to)}`;
  return result;
}

export const pureConstants = {
  name: 'pure-constants',
  setup(build) {
    build.onLoad({ filter: /[\\/]src[\\/].*\.ts$/ }, async ({ path }) => ({ contents: annotatePure(await readFile(path, 'utf8'), path), loader: 'ts' }));
  },
};
