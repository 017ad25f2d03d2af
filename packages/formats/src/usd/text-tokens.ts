/** Blanks and comments, then a text in three or one pair of quotes, a path, an asset, a sign, or a word. */
const TOKEN =
  /(?:\s+|#[^\n]*|\/\*[^]*?\*\/|;)*(?:("""[^]*?"""|'''[^]*?'''|"(?:[^"\\\n]|\\[^])*"|'(?:[^'\\\n]|\\[^])*'|<[^>\n]*>|@@@[^]*?@@@|@[^@\n]*@|[()[\]{}=,]|[^\s()[\]{}=,;"'<@#]+))?/y;
const ESCAPES: Readonly<Record<string, string>> = { n: '\n', t: '\t', r: '\r' };

/**
 * The tokens of a USD text. Texts begin with `"` or `'`, paths with `<`, assets with `@`. At the end the token is
 * empty.
 */
export class UsdTokens {
  readonly #text: string;
  #at = 0;
  #token: string | undefined;

  constructor(text: string) {
    this.#text = text;
  }

  /** The next token, which stays the next. */
  peek(): string {
    if (this.#token === undefined) {
      TOKEN.lastIndex = this.#at;
      const found = TOKEN.exec(this.#text);
      this.#at = TOKEN.lastIndex;
      const token = found?.[1] ?? '';
      if (token === '' && this.#at < this.#text.length)
        throw this.fail(`"${this.#text.slice(this.#at, this.#at + 20)}" is not a token`);
      this.#token = token;
    }
    return this.#token;
  }

  /** @throws {RangeError} at the end. */
  next(): string {
    const token = this.peek();
    if (token === '') throw this.fail('it ends within a prim or a value');
    this.#token = undefined;
    return token;
  }

  /** @throws {RangeError} if the next token is another. */
  expect(token: string): void {
    const found = this.next();
    if (found !== token) throw this.fail(`"${found.slice(0, 40)}" stands where "${token}" is expected`);
  }

  /** The content of a text, a path or an asset. */
  text(): string {
    const token = this.next();
    const marked = /^(?:("""|'''|"|'|@@@|@)([^]*)\1|<([^]*)>)$/.exec(token);
    if (!marked) throw this.fail(`"${token.slice(0, 40)}" stands where a text is expected`);
    const content = (marked[2] ?? marked[3]) as string;
    return /^[@<]/.test(token) ? content : content.replace(/\\([^])/g, (_, c: string) => ESCAPES[c] ?? c);
  }

  fail(message: string): RangeError {
    return new RangeError(`line ${this.#text.slice(0, this.#at).split('\n').length}: ${message}`);
  }
}
