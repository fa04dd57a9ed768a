// Runs every flight in WebAssembly and prints its digest, as src/main.rs does here.
import { readFileSync } from "node:fs";

const bytes = readFileSync(process.argv[2]);
const { exports } = (await WebAssembly.instantiate(bytes, {})).instance;
const text = (pointer, length) => new TextDecoder().decode(new Uint8Array(exports.memory.buffer, pointer, length));
for (let flight = 0; flight < exports.count(); flight += 1) {
    const digest = BigInt.asUintN(64, exports.digest(flight));
    const name = text(exports.name(flight), exports.name_length(flight));
    console.log(`${name} ${digest.toString(16).padStart(16, "0")}`);
}
