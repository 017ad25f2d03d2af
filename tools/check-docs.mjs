// node tools/check-docs.mjs — every symbol that a package exports has a doc comment.
import { existsSync } from 'node:fs';
import { join, relative } from 'node:path';
import ts from 'typescript';
import { root } from './pipeline/process.mjs';
import { Verdicts, columns, runAlone } from './pipeline/report.mjs';
import { entriesOf, publishedPackages } from './pipeline/workspace.mjs';

/** Exported symbols of one entry, with aliases resolved to what they name. */
function exportsOf(checker, source) {
  const module = checker.getSymbolAtLocation(source);
  return (module ? checker.getExportsOfModule(module) : []).map((symbol) => ({
    name: symbol.name,
    symbol: symbol.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(symbol) : symbol,
  }));
}

const hasDoc = (checker, symbol) => ts.displayPartsToString(symbol.getDocumentationComment(checker)).trim().length > 0;

/** Public methods, accessors and fields of a class or interface that have no comment; listed, not failed. */
function bareMembers(checker, symbol) {
  if (!(symbol.flags & (ts.SymbolFlags.Class | ts.SymbolFlags.Interface))) return { total: 0, bare: 0 };
  const members = [...(symbol.members?.values() ?? [])].filter((member) => {
    const [declaration] = member.declarations ?? [];
    if (!declaration || member.name.startsWith('__')) return false;
    if (ts.isPrivateIdentifier(declaration.name ?? declaration)) return false;
    return !(ts.getCombinedModifierFlags(declaration) & (ts.ModifierFlags.Private | ts.ModifierFlags.Protected));
  });
  return { total: members.length, bare: members.filter((member) => !hasDoc(checker, member)).length };
}

export async function checkDocs() {
  const verdicts = new Verdicts();
  const packages = publishedPackages();
  const files = packages
    .flatMap((p) => entriesOf(p).map(({ conditions }) => join(p.dir, conditions['@glanz/source'])))
    .filter((file) => existsSync(file));
  const { config } = ts.readConfigFile(join(root, 'tsconfig.base.json'), ts.sys.readFile);
  const { options } = ts.convertCompilerOptionsFromJson(config.compilerOptions, root);
  const checker = ts.createProgram(files, { ...options, noEmit: true });
  const types = checker.getTypeChecker();
  const rows = [];
  for (const p of packages) {
    const seen = new Set();
    let total = 0;
    let members = 0;
    let bare = 0;
    for (const { specifier, conditions } of entriesOf(p)) {
      const source = checker.getSourceFile(join(p.dir, conditions['@glanz/source']));
      if (!source) continue;
      for (const { name, symbol } of exportsOf(types, source)) {
        if (seen.has(symbol)) continue;
        seen.add(symbol);
        const [declaration] = symbol.declarations ?? [];
        // What is handed on from elsewhere is documented there.
        if (!declaration || declaration.getSourceFile().fileName.includes('node_modules')) continue;
        total++;
        const { line } = declaration.getSourceFile().getLineAndCharacterOfPosition(declaration.getStart());
        verdicts.expect(
          hasDoc(types, symbol),
          `${relative(root, declaration.getSourceFile().fileName)}:${line + 1}: ${name}, exported by ${specifier}, has no doc comment.`,
        );
        const count = bareMembers(types, symbol);
        members += count.total;
        bare += count.bare;
      }
    }
    rows.push([p.name, String(total), String(members - bare), String(members)]);
  }
  verdicts.table.push(...columns([['package', 'symbols', 'members with a comment', 'members'], ...rows], [1, 2, 3]));
  return verdicts;
}

await runAlone(import.meta, checkDocs);
