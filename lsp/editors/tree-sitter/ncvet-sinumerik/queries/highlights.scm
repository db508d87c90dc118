; Made of the tables of the controls by ./dev editors.
(comment) @comment
(string) @string
(program) @function
(tape) @keyword.directive
(block_number) @label
(label) @label
(keyword) @keyword
(operator) @operator
(function) @function.call
(type) @type
(symbol) @constant.builtin
(code) @function.builtin
(miscellaneous) @function.macro
(variable) @variable
(axis) @property
(parameter) @variable.parameter
(number) @number
