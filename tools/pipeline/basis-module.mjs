// The transcoder in the package "three" is a script that lies in a package of ES modules: it exports nothing. This
// gives it a default export, as a plugin of Vite for what is built from the sources of @glanz/element/decoders.
const SCRIPT = /[\\/]basis_transcoder\.js$/;

/**
 * The text of a module; that of the transcoder with an export. @param {string} text @param {string} path @returns
 * {string}
 */
export const withDefault = (text, path) => (SCRIPT.test(path) ? `${text}\nexport default BASIS;` : text);

/** Its specifier, which Vite's optimizer must leave alone. */
export const BASIS_MODULE = 'three/examples/jsm/libs/basis/basis_transcoder.js';

export const basisModule = () => ({
  name: 'basis-module',
  config: () => ({ optimizeDeps: { exclude: [BASIS_MODULE] } }),
  transform: (code, id) => (SCRIPT.test(id) ? { code: withDefault(code, id), map: null } : undefined),
});
