import { CreateError } from './errors';

/** One template: what kind of project it makes. */
export interface Template {
  /** The value of `--template`. */
  readonly name: TemplateName;
  /** What the project is, in a few words. */
  readonly title: string;
}

/** Names of the templates. */
export type TemplateName = 'vanilla' | 'react' | 'next' | 'three' | 'configurator';

/** All templates, in the order in which the command offers them; the first is its default. */
export const TEMPLATES: readonly Template[] = [
  { name: 'vanilla', title: 'a page with the element, TypeScript and Vite' },
  { name: 'react', title: 'React and Vite' },
  { name: 'next', title: 'Next.js with the App Router' },
  { name: 'three', title: 'a three.js scene, path-traced when it rests' },
  { name: 'configurator', title: 'a product whose colours and parts can be chosen' },
];

/** The template of a name. @throws {CreateError} `create-glanz/template` */
export function templateOf(name: string): Template {
  const found = TEMPLATES.find((template) => template.name === name);
  if (!found)
    throw new CreateError(
      'create-glanz/template',
      `There is no template "${name}". Templates: ${TEMPLATES.map((template) => template.name).join(', ')}.`,
    );
  return found;
}
