export { decodeFilmState, encodeFilmState, type FilmPart, type FilmState } from './film/film-state';
export { mergeFilmStates } from './film/merge';
export { readFilmState } from './film/compose';
