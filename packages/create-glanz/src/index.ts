export { CreateError } from './errors';
export { createProject, type CreatedProject, type CreateProjectOptions } from './create-project';
export { TEMPLATES, type Template, type TemplateName } from './templates';
