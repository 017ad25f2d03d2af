export { OPENPBR_TABLES, type OpenPbrTable } from './tables';
