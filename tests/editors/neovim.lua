-- Drives Neovim as a user would, without a screen: `nvim --headless -u NONE -c 'luafile neovim.lua'`. The plan, a
-- JSON file that the variable NCVET_PLAN names, says which steps are to be done one after the other, and with which
-- programs; what went wrong is written into its `result`, a line each, and the last line is `done`.
local plan = vim.fn.json_decode(table.concat(vim.fn.readfile(os.getenv('NCVET_PLAN')), '\n'))

local said, doing = {}, ''
local function fail(...) table.insert(said, doing .. ': ' .. table.concat(vim.tbl_map(tostring, { ... }), ' ')) end
local function finish()
  table.insert(said, 'done')
  vim.fn.writefile(said, plan.result)
  vim.cmd('qall!')
end

-- The newest diagnostics of each file as the server sent them, with the version that they are of.
local published = {}
local show = vim.lsp.handlers['textDocument/publishDiagnostics']
vim.lsp.handlers['textDocument/publishDiagnostics'] = function(error, result, context, config)
  published[vim.uri_to_fname(result.uri)] = { version = result.version }
  return show(error, result, context, config)
end
-- Questions to the user are answered with the first choice that `wanted` takes.
local wanted
vim.ui.select = function(items, options, choose)
  for _, item in ipairs(items) do
    local action = item[2] or item.action or item
    if wanted(action) then return choose(item) end
  end
  choose(nil)
end
local messages = {}
vim.notify = function(message) table.insert(messages, message) end

local patience = tonumber(os.getenv('NCVET_PATIENCE') or 30000) -- ms
local function await(what, condition)
  if vim.wait(patience, condition, 5) then return true end
  fail('waited in vain for', what)
  return false
end

local function client(buffer)
  for _, one in pairs(vim.lsp.buf_get_clients(buffer)) do return one end
end

-- Waits until the diagnostics of what the buffer holds are there: those of a newer version than `before`.
local function settle(buffer, before)
  local file = vim.api.nvim_buf_get_name(buffer)
  return await('diagnostics of ' .. file, function()
    local state, version = published[file], vim.lsp.util.buf_versions[buffer]
    return client(buffer) and version ~= before and state and state.version and state.version >= version
  end)
end

local function text(buffer) return table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), '\n') end

-- Does something to a buffer and waits for what the server says then; false when it says nothing.
local function change(buffer, edit)
  local before, version = text(buffer), vim.lsp.util.buf_versions[buffer]
  edit()
  return text(buffer) == before or settle(buffer, version)
end

local function open(file)
  vim.cmd('edit ' .. vim.fn.fnameescape(file))
  local buffer = vim.api.nvim_get_current_buf()
  -- Of an ending that is anybody's.
  if not vim.bo.filetype:find('^ncvet%-') and vim.bo.filetype ~= 'gcode' then vim.bo.filetype = 'gcode' end
  return settle(buffer) and buffer
end

local function lineAt(buffer, number) return vim.api.nvim_buf_get_lines(buffer, number, number + 1, false)[1] or '' end
local function ruleOf(diagnostic) return diagnostic.code or diagnostic.user_data.lsp.code end

local names = { 'error', 'warning', 'style' }
-- Findings as `line:column severity rule`; columns count characters, from 1.
local function shown(buffer)
  local list = {}
  for _, one in ipairs(vim.diagnostic.get(buffer)) do
    local line = lineAt(buffer, one.lnum)
    local column = vim.str_utfindex(line, math.min(one.col, #line)) + 1
    table.insert(list, string.format('%d:%d %s %s', one.lnum + 1, column, names[one.severity], ruleOf(one)))
  end
  table.sort(list)
  return list
end

-- The same of the command line, of the file as it is on disk.
local function checked(file, dialect)
  local out = vim.fn.system({ plan.ncvet, 'check', '--format', 'json', '--dialect', dialect, file })
  local list = {}
  local report = vim.fn.json_decode(out)
  for _, one in ipairs(report.findings) do
    if vim.fn.resolve(vim.fn.fnamemodify(one.path, ':p')) == vim.fn.resolve(file) then
      table.insert(list, string.format('%d:%d %s %s', one.line, one.column, one.severity, one.rule))
    end
  end
  table.sort(list)
  return list
end

local function compare(what, is, due)
  is, due = table.concat(is, '\n  '), table.concat(due, '\n  ')
  if is ~= due then fail(what .. ': the editor shows\n  ' .. is .. '\n where the command line says\n  ' .. due) end
  return is == due
end

-- What the command line says of the buffer's text; the server knows nothing of its being written.
local function check(buffer, dialect)
  vim.cmd('silent noautocmd write!')
  return checked(vim.api.nvim_buf_get_name(buffer), dialect)
end

local function place(line, column) vim.api.nvim_win_set_cursor(0, { line, column or 0 }) end

local function ask(method, buffer, more)
  local params = vim.tbl_extend('force', vim.lsp.util.make_position_params(), more or {})
  local answers = vim.lsp.buf_request_sync(buffer, method, params, patience)
  for _, answer in pairs(answers or {}) do
    if answer.err then fail(method, answer.err.message) end
    return answer.result
  end
  fail(method, 'was not answered')
end

local steps = {}

-- What is shown of programs that are opened is what the command line says of them.
function steps.open(step)
  for _, program in ipairs(step.programs) do
    local buffer = open(program.path)
    if not buffer then return end
    compare(program.path, shown(buffer), checked(program.path, program.dialect))
    vim.cmd('bwipeout!')
  end
end

-- It stays so while lines are deleted, doubled, typed and brought back.
function steps.edit(step)
  for _, program in ipairs(step.programs) do
    local buffer = open(program.path)
    if not buffer then return end
    local count = vim.api.nvim_buf_line_count(buffer)
    local third = math.max(1, math.floor(count / 3))
    local edits = {
      function() vim.cmd(third .. 'delete') end,
      function() vim.cmd('undo') end,
      function() vim.cmd(math.min(2 * third, count) .. 'copy ' .. third) end,
      function() vim.cmd('normal! GOG987 X1.') end,
      function() vim.cmd('1delete') end,
      function() vim.api.nvim_buf_set_lines(buffer, -1, -1, false, { '(äöü 𝄞) G987' }) end,
      function() vim.cmd('undo') end,
      function() vim.cmd('%join') end,
      function() vim.cmd('undo') end,
    }
    for number, edit in ipairs(edits) do
      if not change(buffer, edit) then return end
      if not compare(program.path .. ' after edit ' .. number, shown(buffer), check(buffer, program.dialect)) then
        break
      end
    end
    vim.cmd('bwipeout!')
  end
end

-- Takes the first action that `wanted` takes at a place; its title, or nil.
local function act(line, column)
  place(line, column)
  local select, chosen, answered = vim.ui.select, nil, false
  vim.ui.select = function(items, options, choose)
    answered = true
    select(items, options, function(item, ...)
      chosen = item and (item[2] or item.action or item).title
      choose(item, ...)
    end)
  end
  messages = {}
  vim.lsp.buf.code_action()
  await('actions', function() return answered or #messages > 0 end)
  vim.ui.select = select
  return chosen
end

-- How many findings of a rule are in lines of this text: an edit above them does not change it.
local function alike(buffer, rule, line)
  local count = 0
  for _, one in ipairs(vim.diagnostic.get(buffer)) do
    if ruleOf(one) == rule and lineAt(buffer, one.lnum) == line then count = count + 1 end
  end
  return count
end

-- Applies an action to one finding each of a few programs, and sees the finding gone. `fits`: whether an action that
-- is about the finding is the one.
local function applyActions(step, most, fits)
  local applied = 0
  for _, program in ipairs(step.programs) do
    local buffer = open(program.path)
    if not buffer then return end
    for _, one in ipairs(vim.diagnostic.get(buffer)) do
      local rule, line = ruleOf(one), lineAt(buffer, one.lnum)
      local before = alike(buffer, rule, line)
      local title
      wanted = function(action)
        local about = action.diagnostics and action.diagnostics[1]
        return about and about.code == rule and fits(action)
      end
      if not change(buffer, function() title = act(one.lnum + 1, one.col) end) then return end
      if title then
        if alike(buffer, rule, line) >= before then fail(program.path, rule, 'is there as before:', title) end
        compare(program.path .. ' after ' .. title, shown(buffer), check(buffer, program.dialect))
        applied = applied + 1
        break
      end
    end
    vim.cmd('bwipeout!')
    if applied == most then return end
  end
  if applied == 0 then fail('no program has a finding with such an action') end
end

-- Some findings are mended by their own fix.
function steps.fix(step)
  applyActions(step, 4, function(action) return action.isPreferred ~= nil end)
end

-- Some findings are silenced by a comment.
function steps.allow(step)
  applyActions(step, 4, function(action) return action.title:find('^Allow .* here$') end)
end

-- The blocks of which the machine's state is known tell it: of a long program, blocks from its begin to its end.
function steps.hover(step)
  local most = 40 -- of a program
  local told = 0
  for _, program in ipairs(step.programs) do
    local buffer = open(program.path)
    if not buffer then return end
    local count = vim.api.nvim_buf_line_count(buffer)
    for line = 1, count, math.ceil(count / most) do
      place(line)
      local hover = ask('textDocument/hover', buffer)
      if hover and hover ~= vim.NIL then
        if #hover.contents.value < 10 then fail(program.path .. ':' .. line, 'says nothing:', hover.contents.value) end
        told = told + 1
      end
    end
    vim.cmd('bwipeout!')
  end
  if told == 0 then fail('nothing is said anywhere') end
end

-- `expect`: words that the hover of the step's place holds.
function steps.hoverAt(step)
  local buffer = open(step.programs[1].path)
  if not buffer then return end
  place(step.line, step.column)
  vim.lsp.buf.hover()
  local text = ''
  await('the window of the hover', function()
    for _, window in ipairs(vim.api.nvim_list_wins()) do
      if vim.api.nvim_win_get_config(window).relative ~= '' then
        text = table.concat(vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false), '\n')
      end
    end
    return text ~= ''
  end)
  for _, word in ipairs(step.expect) do
    if not text:find(word, 1, true) then fail('the hover lacks', word, 'in', text) end
  end
end

-- The step's finding is at the bytes that it is about, although there are characters before it that UTF-16 counts
-- differently.
function steps.columns(step)
  local buffer = open(step.programs[1].path)
  if not buffer then return end
  for _, one in ipairs(vim.diagnostic.get(buffer)) do
    if ruleOf(one) == step.rule then
      local marked = lineAt(buffer, one.lnum):sub(one.col + 1, one.end_col)
      if marked ~= step.text then fail('is at', marked, 'and not at', step.text) end
      return
    end
  end
  fail('there is no finding of', step.rule)
end

-- From the step's place to its target.
function steps.definition(step)
  local buffer = open(step.programs[1].path)
  if not buffer then return end
  place(step.line, step.column)
  vim.lsp.buf.definition()
  await('the jump', function()
    return vim.fn.resolve(vim.api.nvim_buf_get_name(0)) == vim.fn.resolve(step.target.path)
      and vim.api.nvim_win_get_cursor(0)[1] == step.target.line
  end)
end

-- The step's place is renamed to `name`; `after` is the text then.
function steps.rename(step)
  local buffer = open(step.programs[1].path)
  if not buffer then return end
  place(step.line, step.column)
  vim.lsp.buf.rename(step.name)
  if not await('the new name', function() return text(buffer) .. '\n' == step.after end) then fail(text(buffer)) end
end

vim.g.ncvet = { path = plan.ncvet, settings = plan.settings }
vim.opt.runtimepath:prepend(plan.plugin)
vim.opt.swapfile = false
vim.opt.fixendofline = false
vim.opt.fileencodings = 'utf-8,latin1'
vim.cmd('runtime plugin/ncvet.lua')
-- A typist's pauses are nobody's here: Neovim would wait 150 ms after each edit.
local start = vim.lsp.start_client
vim.lsp.start_client = function(config)
  return start(vim.tbl_extend('force', config, { flags = { debounce_text_changes = 0 } }))
end
for _, step in ipairs(plan.steps) do
  doing = step.step
  local ok, problem = xpcall(function() steps[step.step](step) end, debug.traceback)
  if not ok then fail(problem) end
  vim.cmd('silent! %bwipeout!')
  vim.lsp.stop_client(vim.lsp.get_active_clients())
end
finish()
