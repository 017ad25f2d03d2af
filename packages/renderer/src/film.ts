export { decodeFilmState, encodeFilmState } from './film/film-codec';
export type { FilmPart, FilmState } from './film/film-state';
export { mergeFilmStates } from './film/merge';
export { readFilmState } from './film/compose';
