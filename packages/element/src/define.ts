import { defineGlanzViewer } from './element';

// The one entry that does something when it is imported: `import '@glanz/element/define'` is for pages without code of
// their own.
defineGlanzViewer();

export { defineGlanzViewer };
