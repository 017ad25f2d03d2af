/**
 * As much of a browser's database as the store uses, in memory: requests answer later, in order; a transaction ends by
 * itself once no request is open, and refuses further ones. The real one is tried in a browser by the documentation's
 * tests.
 */
export function fakeIndexedDb(
  failPut?: () => Error | undefined,
): IDBFactory & { readonly data: Map<string, Map<string, unknown>> } {
  const data = new Map<string, Map<string, unknown>>();
  const keyPaths = new Map<string, string | undefined>();
  type Fake = {
    result?: unknown;
    error?: unknown;
    onsuccess?: () => void;
    onerror?: () => void;
    onupgradeneeded?: () => void;
  };

  const database = {
    createObjectStore(name: string, options?: { keyPath: string }) {
      data.set(name, new Map());
      keyPaths.set(name, options?.keyPath);
    },
    close: () => undefined,
    transaction(names: string[]) {
      const transaction: {
        error?: unknown;
        oncomplete?: () => void;
        onabort?: () => void;
        onerror?: () => void;
        objectStore?: unknown;
      } = {};
      let open = 0,
        over = false;
      const settle = () => {
        if (open > 0 || over) return;
        over = true;
        setTimeout(() => (transaction.error ? transaction.onabort?.() : transaction.oncomplete?.()));
      };
      const request = (run: () => unknown): Fake => {
        if (over) throw new Error('TransactionInactiveError');
        open++;
        const answer: Fake = {};
        setTimeout(() => {
          try {
            answer.result = run();
            answer.onsuccess?.();
          } catch (error) {
            transaction.error = answer.error = error;
            answer.onerror?.();
          }
          open--;
          // Callers that wait for the answer run first.
          setTimeout(settle);
        });
        return answer;
      };
      transaction.objectStore = (name: string) => {
        if (!names.includes(name)) throw new Error('NotFoundError');
        const store = data.get(name)!;
        return {
          get: (key: string) => request(() => structuredClone(store.get(key))),
          getAll: () => request(() => [...store.values()].map((value) => structuredClone(value))),
          put: (value: Record<string, string>, key?: string) =>
            request(() => {
              const error = failPut?.();
              if (error) throw error;
              store.set(key ?? value[keyPaths.get(name)!]!, structuredClone(value));
            }),
          delete: (key: string) => request(() => void store.delete(key)),
          clear: () => request(() => store.clear()),
        };
      };
      return transaction;
    },
  };
  const factory = {
    data,
    open() {
      const request: Fake = { result: database };
      setTimeout(() => {
        if (data.size === 0) request.onupgradeneeded?.();
        request.onsuccess?.();
      });
      return request;
    },
  };
  return factory as unknown as IDBFactory & { readonly data: Map<string, Map<string, unknown>> };
}
