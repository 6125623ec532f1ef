// A form from a JSON schema: reads {schema, formData}, writes {html, errors} as JSON.

import Form from "@rjsf/core";
import validator from "@rjsf/validator-ajv8";
import React from "react";
import { renderToStaticMarkup } from "react-dom/server";

const { schema, formData } = JSON.parse(await new Response(Deno.stdin.readable).text());
const html = renderToStaticMarkup(React.createElement(Form, { schema, validator, formData }));
const errors = validator.validateFormData(formData, schema).errors.map(({ property, message }) => `${property} ${message}`);
console.log(JSON.stringify({ html, errors }));
// what would draw again later keeps the process alive
Deno.exit(0);
