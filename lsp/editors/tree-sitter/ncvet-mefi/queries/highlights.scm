; Made of the tables of the controls by ./dev editors.
(comment) @comment
(tape) @keyword.directive
(block_number) @label
(code) @function.builtin
(miscellaneous) @function.macro
(variable) @variable
(axis) @property
(parameter) @variable.parameter
(number) @number
(operator) @operator
