export { decodeFilmState, encodeFilmPieces, encodeFilmState } from './film/film-codec';
export type { FilmPart, FilmState } from './film/film-state';
export { mergeFilmStates } from './film/merge';
export { mergeFilmSources, type FilmSource, type MergeOptions } from './film/merge-sources';
export { readFilmState } from './film/compose';
