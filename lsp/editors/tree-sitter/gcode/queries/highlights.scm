; Made of the tables of the controls by ./dev editors.
(comment) @comment
(program) @function
(tape) @keyword.directive
(block_number) @label
(keyword) @keyword
(operator) @operator
(function) @function.call
(code) @function.builtin
(miscellaneous) @function.macro
(variable) @variable
(axis) @property
(parameter) @variable.parameter
(number) @number
