// Makes custom-elements.json (schema 1.0.0), from which editors and documentation tools know <glanz-viewer>, out of the
// sources: attributes and their comments of src/attributes.ts, events and methods of src/api.ts, slots, parts and CSS
// properties of the comment in src/shadow.ts; values and defaults of the renderer's options of their table. The build
// writes it into dist/.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { runInNewContext } from 'node:vm';
import { buildSync } from 'esbuild';
import ts from 'typescript';

const TYPES = { text: 'string', flag: 'boolean', number: 'number' };
const camel = (name) => name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());

function parse(folder, file) {
  const path = `${folder}/src/${file}`;
  return ts.createSourceFile(path, readFileSync(path, 'utf8'), ts.ScriptTarget.Latest, true);
}

/** The declaration of a name at the top of a file. */
function find(source, name) {
  for (const statement of source.statements) {
    if (statement.name?.text === name) return statement;
    const declaration = statement.declarationList?.declarations.find((one) => one.name.text === name);
    if (declaration) return declaration;
  }
  throw new Error(`${source.fileName} declares no ${name}.`);
}

/** The comment of a node: its text on one line, and its tags. */
function comment(node) {
  const [doc] = ts.getJSDocCommentsAndTags(node).filter(ts.isJSDoc);
  const text = (part) =>
    (ts.getTextOfJSDocComment(part) ?? '')
      .replace(/\s+/g, ' ')
      .replace(/\{@link (\w+)\}/g, '`$1`')
      .trim();
  return {
    description: text(doc?.comment),
    tags: (doc?.tags ?? []).map((tag) => ({ name: tag.tagName.text, text: text(tag.comment) })),
  };
}

const tag = ({ tags }, name) => tags.find((one) => one.name === name)?.text;

/** The table of the renderer's options. */
function renderOptions(folder) {
  const table = `${folder}/../renderer/src/render-options/table.ts`;
  const [{ text }] = buildSync({ entryPoints: [table], bundle: true, format: 'cjs', write: false }).outputFiles;
  const module = { exports: {} };
  runInNewContext(text, { module });
  return module.exports.RENDER_OPTIONS;
}

function attributesOf(source, options) {
  let object = find(source, 'ATTRIBUTES').initializer;
  while (!ts.isObjectLiteralExpression(object)) object = object.expression;
  return object.properties.map((property) => {
    const { text: name } = property.name;
    const doc = comment(property);
    const option = options[tag(doc, 'option')];
    const values = (option?.values ?? tag(doc, 'values')?.split(','))?.map((value) => `'${value.trim()}'`).join(' | ');
    const byDefault = option ? option.default?.toString() : tag(doc, 'defaultValue');
    const type = { text: values ?? TYPES[property.initializer.text] };
    const deprecated = tag(doc, 'deprecated');
    return {
      name,
      fieldName: camel(name),
      type,
      description: doc.description,
      ...(byDefault === undefined ? {} : { default: byDefault }),
      ...(deprecated === undefined ? {} : { deprecated }),
    };
  });
}

const nameOf = (member) => member.name.text;

function eventsOf(source) {
  return find(source, 'GlanzViewerEventMap').members.map((member) => ({
    name: nameOf(member),
    type: { text: member.type.getText() },
    description: comment(member).description,
  }));
}

function membersOf(source, attributes) {
  const fields = attributes.map(({ name, fieldName, type, description, deprecated }) => ({
    kind: 'field',
    name: fieldName,
    type,
    description,
    attribute: name,
    reflects: true,
    ...(deprecated === undefined ? {} : { deprecated }),
  }));
  const own = find(source, 'GlanzViewerElement').members.flatMap((member) => {
    const { description } = comment(member);
    if (nameOf(member).endsWith('EventListener') || attributes.some(({ fieldName }) => fieldName === nameOf(member)))
      return [];
    if (ts.isPropertySignature(member))
      return [
        { kind: 'field', name: nameOf(member), type: { text: member.type.getText() }, description, readonly: true },
      ];
    const parameters = member.parameters.map((one) => ({
      name: one.name.getText(),
      type: { text: one.type.getText() },
      ...(one.questionToken ? { optional: true } : {}),
    }));
    return [
      {
        kind: 'method',
        name: nameOf(member),
        parameters,
        return: { type: { text: member.type.getText() } },
        description,
      },
    ];
  });
  return [...fields, ...own];
}

/** `@slot name - description` and the like. */
function tagged(doc, name) {
  return doc.tags
    .filter((one) => one.name === name)
    .map(({ text }) => {
      const [, of, description] = /^(\S+) - (.+)$/.exec(text) ?? [];
      if (!of) throw new Error(`@${name} ${text}: expected "name - description".`);
      return { name: of, description };
    });
}

/** The manifest as data. @param folder The package's. */
export function customElements(folder = fileURLToPath(new URL('..', import.meta.url)).replace(/[\\/]$/, '')) {
  const api = parse(folder, 'api.ts');
  const attributes = attributesOf(parse(folder, 'attributes.ts'), renderOptions(folder));
  const shadow = comment(find(parse(folder, 'shadow.ts'), 'fillShadow'));
  const element = find(api, 'GlanzViewerElement');
  const path = 'dist/define.js';
  return {
    schemaVersion: '1.0.0',
    readme: 'README.md',
    modules: [
      {
        kind: 'javascript-module',
        path,
        declarations: [
          {
            kind: 'class',
            customElement: true,
            name: 'GlanzViewerElement',
            tagName: 'glanz-viewer',
            description: comment(element).description,
            superclass: { name: 'HTMLElement' },
            attributes,
            members: membersOf(api, attributes),
            events: eventsOf(api),
            slots: tagged(shadow, 'slot'),
            cssParts: tagged(shadow, 'csspart'),
            cssProperties: tagged(shadow, 'cssprop'),
          },
        ],
        exports: [
          {
            kind: 'custom-element-definition',
            name: 'glanz-viewer',
            declaration: { name: 'GlanzViewerElement', module: path },
          },
        ],
      },
    ],
  };
}
