/** Writes the sample model of the quick starts. @param folder The package's. @param file Where the model goes. */
export function writeSample(folder: string, file: string): Promise<void>;
