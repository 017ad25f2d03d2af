const LOOPBACK = /^(localhost|127(\.\d{1,3}){3}|\[::1\])(:\d{1,5})?$/i;

/**
 * Whether a request to a server that listens on the loopback address names a host of this machine (`localhost`,
 * `127.0.0.0/8`, `[::1]`) in its `Host` header. A page of another origin can make its own name point at this machine
 * (DNS rebinding) and would read the answers as its own; requests of it carry that name.
 *
 * @param request An `IncomingMessage` of `node:http`.
 * @param bound `server.address()`; on any other address all requests are accepted, since names there are not known.
 */
export function acceptsHost(
  request: { readonly headers: { readonly host?: string | undefined } },
  bound: { readonly address?: string } | string | null,
): boolean {
  const address = typeof bound === 'object' ? bound?.address : undefined;
  if (address === undefined || !/^(127\.|::1$|::ffff:127\.)/.test(address)) return true;
  return LOOPBACK.test(request.headers.host ?? '');
}
