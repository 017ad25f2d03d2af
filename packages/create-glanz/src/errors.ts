import { GlanzError } from '@glanz/wgsl/error';

/**
 * A project cannot be created. Codes:
 *
 * - `create-glanz/template`: there is no template of that name; the message lists those there are.
 * - `create-glanz/name`: the last part of the folder gives no name that npm accepts for a package.
 * - `create-glanz/folder`: the folder has files in it, or is a file.
 * - `create-glanz/write`: a file cannot be written; `cause` is what the file system said.
 * - `create-glanz/usage`: the command has an option that it does not know, or too many arguments.
 */
export class CreateError extends GlanzError {}
