// What the manifests of all published packages have in common, from one place: the package.json of the root.
//
// Root field           in a package
// author, license      the same; a package with files under another licence says so as glanz.license
// keywords             at the end of the package's own
// repository.url       repository (with the package's folder), homepage, bugs; none of them while the address is empty
import { join } from 'node:path';

/** What a stability label promises; CONTRIBUTING.md explains each. */
export const STABILITY = ['experimental', 'beta', 'stable'];

/** The address of the repository as a browser opens it, or `undefined` while the root's manifest has none. */
export function webAddress(rootManifest) {
  const url =
    typeof rootManifest.repository === 'string' ? rootManifest.repository : (rootManifest.repository?.url ?? '');
  if (url.trim() === '') return undefined;
  return url
    .trim()
    .replace(/^git\+/, '')
    .replace(/\.git$/, '')
    .replace(/\/$/, '');
}

/**
 * Address of the page on errors, which ends messages in development builds: in the documentation (`homepage` of the
 * root), else its source in the repository; `undefined` while the root's manifest has neither.
 */
export function errorsPage(rootManifest) {
  if (rootManifest.homepage) return `${rootManifest.homepage.replace(/\/$/, '')}/guide/errors`;
  const web = webAddress(rootManifest);
  return web && `${web}/blob/HEAD/apps/docs/guide/errors.md`;
}

/** The fields that a package takes from the root, `undefined` for one that it must not have. */
export function commonFields(rootManifest, folder, ownKeywords, license) {
  const web = webAddress(rootManifest);
  const common = rootManifest.keywords ?? [];
  return {
    keywords: [...ownKeywords.filter((word) => !common.includes(word)), ...common],
    author: rootManifest.author,
    license: license ?? rootManifest.license,
    homepage: web && (rootManifest.homepage || `${web}/tree/HEAD/${folder}#readme`),
    bugs: web && { url: `${web}/issues` },
    repository: web && { type: 'git', url: `git+${web}.git`, directory: folder },
  };
}

/** Scripts that npm and pnpm run around packing and publishing; `tools/pack-hook.mjs` explains them. */
const HOOKS = {
  prepack: 'node ../../tools/pack-hook.mjs prepack',
  postpack: 'node ../../tools/pack-hook.mjs postpack',
  prepublishOnly: 'node ../../tools/pack-hook.mjs prepublish',
};

const FIRST = [
  'name',
  'version',
  'description',
  'keywords',
  'author',
  'license',
  'homepage',
  'bugs',
  'repository',
  'glanz',
];

/** A package's manifest as it should be: its own fields, and those of the root. */
export function completeManifest(manifest, rootManifest, folder) {
  const fields = {
    ...manifest,
    ...commonFields(rootManifest, folder, manifest.keywords ?? [], manifest.glanz?.license),
  };
  fields.scripts = { ...manifest.scripts, ...HOOKS };
  // Provenance: the registry shows from which commit and by which workflow a version was built.
  fields.publishConfig = { access: 'public', provenance: true, ...manifest.publishConfig };
  const ordered = Object.fromEntries(FIRST.filter((key) => fields[key] !== undefined).map((key) => [key, fields[key]]));
  for (const [key, value] of Object.entries(fields)) if (value !== undefined) ordered[key] = value;
  return ordered;
}

/**
 * Links of a README as the registry's page needs them: those that are relative in the repository become absolute. Code
 * blocks stay as they are.
 */
export function absoluteLinks(markdown, web, folder) {
  const parts = markdown.split(/(^```[\s\S]*?^```)/m);
  return parts
    .map((part, i) => {
      if (i % 2 === 1) return part;
      return part.replace(
        /(!?)(\[(?:[^\]\\]|\\.)*\]\()(?![a-z][a-z0-9+.-]*:|#|\/)([^)\s]+)/gi,
        (_, image, text, href) => {
          const [path, hash = ''] = href.split(/(?=#)/);
          const target = join(folder, path).replaceAll('\\', '/').replace(/\/$/, '');
          const kind = image ? 'raw' : /\.[a-z0-9]+$/i.test(target) || target === 'LICENSE' ? 'blob' : 'tree';
          return `${image}${text}${web}/${kind}/HEAD/${target === '.' ? '' : target}${hash}`;
        },
      );
    })
    .join('');
}
