// What the waiting changesets add up to, as `npm run release:dry` shows it.
import getReleasePlan from '@changesets/get-release-plan';
import { root } from './process.mjs';

/**
 * The releases, and the changesets that they come from. Reads files alone: `changeset status` compares with the branch
 * "main" too, which a checkout of one commit does not have, and fails where packages have changed without a changeset.
 */
export const releasePlan = (base = root) => getReleasePlan(base);

/**
 * Packages that would get a major version without a changeset that says "major". Changesets raises every package whose
 * peer dependency leaves its range, which would publish 1.0.0 by accident.
 */
export const accidentalMajors = ({ changesets, releases }) =>
  releases
    .filter(({ type }) => type === 'major')
    .map(({ name }) => name)
    .filter(
      (name) =>
        !changesets.some((changeset) =>
          changeset.releases.some((release) => release.name === name && release.type === 'major'),
        ),
    );
