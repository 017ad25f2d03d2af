import type { LinkContent } from './link';

const list = (parts: readonly string[]) =>
  parts.length > 1 ? `${parts.slice(0, -1).join(', ')} and ${parts.at(-1)}` : (parts[0] ?? '');
const counted = (images: number) => (images === 1 ? 'one changed texture' : `${images} changed textures`);

/**
 * The files that a link does not contain, as a list in words; empty where it contains everything. @param dropped Whether the
 * model is a file.
 */
function leftOut({ model, state, files }: LinkContent, dropped: boolean): string {
  const environment =
    state.environment === 'file' ? `the environment${files?.environment ? ` "${files.environment}"` : ''}` : undefined;
  return list([
    ...(dropped ? [`the model "${model}"`] : []),
    ...(environment ? [environment] : []),
    ...(files?.images ? [`${counted(files.images)} on materials`] : []),
  ]);
}

/** What a link does not contain, for the person who creates it; empty where it contains everything. */
export function textForSender(content: LinkContent, dropped: boolean): string {
  const files = leftOut(content, dropped);
  return (
    files &&
    `The link does not contain ${files}: files do not fit into a URL. Send them separately; the page asks for them when the link is opened.`
  );
}

/** What a link does not contain, for the person who opens it; empty where it contains everything. */
export function textForReceiver(content: LinkContent, dropped: boolean): string {
  const files = leftOut(content, dropped);
  if (!files) return '';
  const lit = content.state.environment === 'file' ? ' Until then, a studio environment lights the model.' : '';
  const drop =
    dropped || content.state.environment === 'file'
      ? ` Drop ${dropped && content.state.environment === 'file' ? 'these files' : 'that file'} to see the scene as it was shared.${lit}`
      : '';
  return `This link was created with ${files}, which it does not contain.${drop}`;
}
