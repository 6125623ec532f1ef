// Types for TypeScript from the service's document: the path of openapi.json, and of the file to write.

import openapiTS, { astToString } from "openapi-typescript";

const [document, types] = Deno.args;
const read = JSON.parse(await Deno.readTextFile(document));
// what has a default may be left out of a request
await Deno.writeTextFile(types, astToString(await openapiTS(read, { defaultNonNullable: false })));
