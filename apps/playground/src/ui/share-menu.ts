import { toClipboard } from '../output/clipboard';
import type { CodeKind } from '../output/snippets';
import { encodeLink, linkContent, LONGEST_LINK, type LinkContent } from '../state/link';
import { textForSender } from '../state/link-texts';
import type { Context } from './context';
import { byId, element } from './elements';
import { item } from './menu-item';

/** The content of a link to the current view. */
const contentOf = ({ opened, store, environments }: Context): LinkContent =>
  linkContent(opened().name, store.state, environments.fileName);

/** What a link to the current view does not contain, in words; empty where it contains everything. */
const leftOutOf = (context: Context): string =>
  textForSender(contentOf(context), context.opened().request.kind === 'files');

/** The URL of the current view. */
async function linkTo(context: Context): Promise<string> {
  const link = await encodeLink(contentOf(context));
  return `${location.origin}${location.pathname}#${link}`;
}

async function copy(
  text: string,
  say: (text: string) => void,
  what: string,
  instead: string,
  more = '',
): Promise<void> {
  await toClipboard(() => navigator.clipboard.writeText(text), instead);
  say(`${what} is on the clipboard. ${more}`.trim());
}

const CODE_KINDS: readonly (readonly [CodeKind, string])[] = [
  ['renderer', 'Renderer, TypeScript'],
  ['viewer', 'Viewer, TypeScript'],
  ['html', 'Element, HTML'],
  ['react', 'React component'],
];

/** A link to the view, and code that shows the same scene. */
export function shareMenu(context: Context): HTMLElement[] {
  const { say, fail } = context;
  const kind = element(
    'select',
    { id: 'code-kind', 'aria-label': 'Code for' },
    ...CODE_KINDS.map(([value, title]) => element('option', { value }, title)),
  );
  const code = element('pre', {
    class: 'snippet',
    id: 'snippet',
    role: 'group',
    tabindex: 0,
    'aria-label': 'Code that renders this image',
  });
  const note = element('p', { class: 'note', id: 'share-note' });
  const write = () =>
    void import('../output/snippets').then(
      ({ codeFor }) => (code.textContent = codeFor(kind.value as CodeKind, context)),
      fail,
    );
  const refresh = () => {
    note.textContent = leftOutOf(context);
    write();
  };
  byId('share-menu').addEventListener('beforetoggle', (event) => {
    if ((event as ToggleEvent).newState === 'open') refresh();
  });
  refresh();
  kind.addEventListener('change', write);
  return [
    element('h2', {}, 'Link'),
    item(
      'copy-link',
      'Copy link',
      'Camera, materials, light and settings',
      async () => {
        const link = await linkTo(context);
        await copy(
          link,
          say,
          link.length > LONGEST_LINK ? 'The link, which is too long for some programs,' : 'The link',
          `The link: ${link}`,
          leftOutOf(context),
        );
      },
      fail,
    ),
    note,
    element('h2', {}, 'Code'),
    item(
      'copy-code',
      'Copy code',
      'Code that shows this scene',
      () => copy(code.textContent ?? '', say, 'The code', 'Select the code in the menu to copy it.'),
      fail,
    ),
    kind,
    code,
  ];
}
