// The codes of errors and warnings that a package's sources contain, found in their syntax: 'package/what' as a
// literal, or a template `package/${what}` in a function, whose calls carry the rest. The documentation has a paragraph
// for each.
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import ts from 'typescript';

/** Calls whose first argument is the name of a module, of shader text or of JavaScript. */
const NAMES = new Set(['wgslModule', 'import']);

const isSkipped = (node) => ts.isImportDeclaration(node) || ts.isExportDeclaration(node) || ts.isTypeNode(node);

/** Functions that put a prefix before one of their parameters: name → prefix and the parameter's place. */
function helpersOf(source, shape, helpers) {
  const visit = (node, enclosing) => {
    let inside = enclosing;
    if (ts.isFunctionDeclaration(node) && node.name) inside = { name: node.name.text, parameters: node.parameters };
    if (ts.isVariableDeclaration(node) && node.initializer && ts.isArrowFunction(node.initializer))
      inside = { name: node.name.getText(), parameters: node.initializer.parameters };
    if (
      inside &&
      ts.isTemplateExpression(node) &&
      node.templateSpans.length === 1 &&
      shape.test(`${node.head.text}x`) &&
      node.templateSpans[0].literal.text === ''
    ) {
      const place = inside.parameters.findIndex(
        (one) => one.name.getText() === node.templateSpans[0].expression.getText(),
      );
      if (place >= 0 && !NAMES.has(node.parent.expression?.getText()))
        helpers.set(inside.name, { prefix: node.head.text, place });
    }
    ts.forEachChild(node, (child) => visit(child, inside));
  };
  visit(source, undefined);
}

/**
 * All codes of a package, each once, with where they are.
 *
 * @param {ReadonlyMap<string, string>} files Path and text of the package's sources.
 * @returns {Map<string, string[]>} Code → `file:line`, in alphabetical order.
 */
export function codesIn(packageName, files) {
  const shape = new RegExp(`^${packageName}/[a-z][a-z0-9-]*$`);
  const sources = [...files].map(([file, text]) => ts.createSourceFile(file, text, ts.ScriptTarget.Latest, true));
  const helpers = new Map();
  for (const source of sources) helpersOf(source, shape, helpers);
  const found = new Map();
  for (const source of sources) {
    const add = (code, node) => {
      const place = `${source.fileName}:${source.getLineAndCharacterOfPosition(node.getStart()).line + 1}`;
      found.set(code, [...(found.get(code) ?? []), place]);
    };
    const visit = (node) => {
      if (isSkipped(node)) return;
      if (ts.isCallExpression(node)) {
        const name = node.expression.getText().split(/[.#]+/).at(-1);
        const helper = helpers.get(name);
        const what = helper && node.arguments[helper.place];
        if (what && ts.isStringLiteralLike(what)) add(helper.prefix + what.text, what);
        if (NAMES.has(name)) return node.arguments.slice(1).forEach(visit);
      }
      if (ts.isStringLiteralLike(node) && shape.test(node.text)) add(node.text, node);
      ts.forEachChild(node, visit);
    };
    visit(source);
  }
  return new Map([...found].sort(([a], [b]) => a.localeCompare(b)));
}

/** The codes of the package whose sources lie in `folder`. */
export function errorCodes(packageName, folder) {
  const files = readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((file) => file.endsWith('.ts'))
    .sort();
  return codesIn(packageName, new Map(files.map((file) => [file, readFileSync(join(folder, file), 'utf8')])));
}
