/** Files of a file input; of a folder input with their paths. */
export function filesOfInput(input: HTMLInputElement): Map<string, File> {
  return new Map([...(input.files ?? [])].map((file) => [file.webkitRelativePath || file.name, file]));
}

const fileOf = (entry: FileSystemFileEntry) => new Promise<File>((resolve, reject) => entry.file(resolve, reject));
const batchOf = (reader: FileSystemDirectoryReader) =>
  new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));

async function walk(entry: FileSystemEntry, files: Map<string, File>): Promise<void> {
  if (entry.isFile) files.set(entry.fullPath.replace(/^\//, ''), await fileOf(entry as FileSystemFileEntry));
  else if (entry.isDirectory) {
    const reader = (entry as FileSystemDirectoryEntry).createReader();
    // A reader gives entries in batches until one is empty.
    for (let batch = await batchOf(reader); batch.length > 0; batch = await batchOf(reader)) {
      for (const child of batch) await walk(child, files);
    }
  }
}

/** Files and folders of a drop. Call it in the event itself: later the transfer is empty. */
export function filesOfDrop(transfer: DataTransfer): Promise<Map<string, File>> {
  const entries = [...transfer.items].flatMap((item) =>
    item.kind === 'file' ? [item.webkitGetAsEntry?.() ?? null] : [],
  );
  const plain = [...transfer.files];
  return (async () => {
    const files = new Map<string, File>();
    if (entries.length > 0 && entries.every((entry) => entry !== null))
      for (const entry of entries) await walk(entry, files);
    // Scripted transfers and old browsers have files without entries.
    if (files.size === 0) for (const file of plain) files.set(file.name, file);
    return files;
  })();
}
