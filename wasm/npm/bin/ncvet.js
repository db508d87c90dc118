#!/usr/bin/env node
// The command `ncvet`.
'use strict';

const { main } = require('../lib/ncvet.js');

main(process.argv.slice(2)).then(
  (status) => process.exit(status),
  (error) => {
    process.stderr.write(`ncvet: ${error?.stack ?? error}\n`);
    process.exit(2);
  }
);
