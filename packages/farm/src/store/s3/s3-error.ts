import { FarmError } from '../../error';

/** What the SDK throws. */
interface S3Failure extends Error {
  readonly Code?: string;
  readonly code?: string;
  readonly $metadata?: { readonly httpStatusCode?: number };
}

const DENIED = new Set([
  'AccessDenied',
  'Forbidden',
  'InvalidAccessKeyId',
  'SignatureDoesNotMatch',
  'ExpiredToken',
  'InvalidToken',
]);

const codeOf = ({ Code, name }: S3Failure) => Code ?? name;

/** Whether an error says that there is no such object. */
export function isMissing(error: unknown): boolean {
  const code = codeOf(error as S3Failure);
  if (code === 'NoSuchBucket') return false;
  return code === 'NoSuchKey' || code === 'NotFound' || (error as S3Failure).$metadata?.httpStatusCode === 404;
}

/** Whether a server refuses a condition, since the object is there already. */
export const isThere = (error: unknown): boolean =>
  codeOf(error as S3Failure) === 'PreconditionFailed' ||
  codeOf(error as S3Failure) === 'ConditionalRequestConflict' ||
  (error as S3Failure).$metadata?.httpStatusCode === 412;

/** Whether a server does not know a request. */
export const isUnknown = (error: unknown): boolean =>
  codeOf(error as S3Failure) === 'NotImplemented' || (error as S3Failure).$metadata?.httpStatusCode === 501;

/** The error without its connection, which loggers would print in full. */
function withoutResponse({ name, message, stack }: S3Failure): Error {
  const error = new Error(message);
  error.name = name;
  if (stack !== undefined) error.stack = stack;
  return error;
}

/**
 * What an error of the SDK means, in one line.
 *
 * @param what Continues "Cannot": `read "objects/…"`.
 */
export function s3Error(error: unknown, what: string, url: string, endpoint: string | undefined): FarmError {
  if (error instanceof FarmError) return error;
  const failure = error as S3Failure;
  const code = codeOf(failure);
  const at = endpoint === undefined ? '' : ` at ${endpoint}`;
  const fail = (kind: 'farm/store' | 'farm/store-access', message: string) =>
    new FarmError(kind, message, { cause: withoutResponse(failure), location: { file: url } });
  if (code === 'NoSuchBucket')
    return fail('farm/store-access', `${url}: there is no such bucket${at}. Create it, or name another one.`);
  if (code === 'CredentialsProviderError')
    return fail(
      'farm/store-access',
      `${url}: no credentials. Set AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, or AWS_PROFILE.`,
    );
  if (code === 'PermanentRedirect' || code === 'AuthorizationHeaderMalformed')
    return fail('farm/store-access', `${url}: the bucket is in another region. Set AWS_REGION.`);
  if (DENIED.has(code) || failure.$metadata?.httpStatusCode === 403)
    return fail(
      'farm/store-access',
      `${url}: access denied${at} (${code}). The credentials need s3:ListBucket, s3:GetObject, s3:PutObject and s3:DeleteObject.`,
    );
  const why = failure.message || failure.code || code;
  return fail('farm/store', `${url}: cannot ${what}${at}: ${why.replace(/\.?\s*$/, '.')}`);
}
