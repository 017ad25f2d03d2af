import { GlanzError } from '@glanz/wgsl/error';

/**
 * A project cannot be created. Codes:
 *
 * - `create-glanz/template`: there is no template of that name; the message lists the templates.
 * - `create-glanz/name`: npm does not accept the last part of the folder as the name of a package.
 * - `create-glanz/folder`: the folder has files in it, or is a file.
 * - `create-glanz/write`: a file cannot be written; `cause` is the error of the file system.
 * - `create-glanz/usage`: the command has an option that it does not know, or too many arguments.
 */
export class CreateError extends GlanzError {}
