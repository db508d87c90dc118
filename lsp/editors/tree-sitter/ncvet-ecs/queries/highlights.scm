; Made of the tables of the controls by ./dev editors.
(comment) @comment
(string) @string
(program) @function
(block_number) @label
(label) @label
(keyword) @keyword
(function) @function.call
(code) @function.builtin
(miscellaneous) @function.macro
(variable) @variable
(axis) @property
(parameter) @variable.parameter
(number) @number
(operator) @operator
