// SPDX-License-Identifier: BSD-3-Clause
// usage: node --no-warnings wasi.mjs PROGRAM.wasm FOLDER [ARGUMENT...]
// Runs a program for WASI, which sees the folder as its working folder.
import { readFile } from "node:fs/promises";
import { WASI } from "node:wasi";

const [program, folder, ...words] = process.argv.slice(2);
const wasi = new WASI({ version: "preview1", args: [program, ...words], preopens: { ".": folder } });
const code = await WebAssembly.compile(await readFile(program));
process.exit(wasi.start(await WebAssembly.instantiate(code, wasi.getImportObject())));
