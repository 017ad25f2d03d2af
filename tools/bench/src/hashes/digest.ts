import { createHash } from 'node:crypto';

/** The first 16 hexadecimal digits of the SHA-256 of text or of numbers, bit for bit. */
export function digest(data: string | Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>): string {
  const hash = createHash('sha256');
  if (typeof data === 'string') hash.update(data);
  else hash.update(new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
  return hash.digest('hex').slice(0, 16);
}

const TOKEN =
  /\/\/[^\n]*|\/\*[\s\S]*?\*\/|[A-Za-z_][\w]*|(?:\d|\.\d)(?:[eEpP][-+]|[\w.])*|<<=|>>=|->|\+\+|--|&&|\|\||[-+*/%&|^=!<>]=|<<|>>|\S/g;

/** The tokens of a WGSL program, without comments. Spaces and line breaks between tokens do not change it. */
export const wgslTokens = (code: string): string[] =>
  (code.match(TOKEN) ?? []).filter((token) => !/^\/[/*]/.test(token));

/** The declarations of a program, each as its tokens with one space between. */
export function wgslDeclarations(code: string): string[] {
  const declarations: string[] = [];
  let depth = 0;
  let begun: string[] = [];
  for (const token of wgslTokens(code)) {
    begun.push(token);
    if (token === '{' || token === '(') depth++;
    if (token === '}' || token === ')') depth--;
    if (depth > 0 || (token !== ';' && token !== '}')) continue;
    declarations.push(begun.join(' '));
    begun = [];
  }
  return begun.length > 0 ? [...declarations, begun.join(' ')] : declarations;
}

/** Hash of a program that does not depend on comments, spaces, line breaks and the order of its declarations. */
export const programDigest = (code: string): string => digest(wgslDeclarations(code).sort().join('\n'));

/** The mean of each of `channels` interleaved channels. Values that are not finite make it so too. */
export function channelMeans(data: ArrayLike<number>, channels: number): number[] {
  const sums = Array.from({ length: channels }, () => 0);
  for (let i = 0; i < data.length; i++) sums[i % channels]! += data[i]!;
  return sums.map((sum) => sum / (data.length / channels));
}
