-- Part programs in Neovim, 0.7 and later: their file types, and `ncvet lsp` for them.
local config = dofile(vim.api.nvim_get_runtime_file('lsp/ncvet.lua', false)[1])

-- Endings that several controls use are `gcode`: the control is found out from the text.
local endings = {
  gcode = { 'nc', 'cnc', 'tap', 'eia', 'min', 'nct', 'ngc', 'din', 'iso', 'gcode' },
  ['ncvet-sinumerik'] = { 'mpf', 'spf', 'arc' },
  ['ncvet-mefi'] = { 'ncp' },
  ['ncvet-ecs'] = { 'ecs' },
}
local comments = { ['ncvet-sinumerik'] = ';%s', ['ncvet-mefi'] = '"%s', ['ncvet-ecs'] = "'%s" }

local group = vim.api.nvim_create_augroup('ncvet', {})
for filetype, list in pairs(endings) do
  for _, ending in ipairs(list) do
    local anyCase = ending:gsub('%a', function(letter)
      return '[' .. letter .. letter:upper() .. ']'
    end)
    vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, {
      group = group,
      pattern = '*.' .. anyCase,
      -- Not `setfiletype`: Neovim itself takes some of the endings for something else.
      callback = function() vim.bo.filetype = filetype end,
    })
  end
end
vim.api.nvim_create_autocmd('FileType', {
  group = group,
  pattern = config.filetypes,
  callback = function(event)
    vim.bo.commentstring = comments[event and event.match or vim.bo.filetype] or '(%s)'
  end,
})

if vim.lsp.enable then -- 0.11 and later read lsp/ncvet.lua themselves
  vim.lsp.enable('ncvet')
  return
end

-- One server for all programs below the same folder.
local servers = {}

local function rootOf(file)
  local folder = vim.fn.fnamemodify(file, ':p:h')
  local at = folder
  repeat
    for _, marker in ipairs(config.root_markers) do
      if vim.loop.fs_stat(at .. '/' .. marker) then return at end
    end
    local last = at
    at = vim.fn.fnamemodify(at, ':h')
  until at == last
  return folder
end

vim.api.nvim_create_autocmd('FileType', {
  group = group,
  pattern = config.filetypes,
  callback = function()
    local buffer = vim.api.nvim_get_current_buf()
    local root = rootOf(vim.api.nvim_buf_get_name(buffer))
    if not servers[root] or not vim.lsp.get_client_by_id(servers[root]) then
      servers[root] = vim.lsp.start_client({
        name = 'ncvet',
        cmd = config.cmd,
        root_dir = root,
        workspace_folders = { { uri = vim.uri_from_fname(root), name = root } },
        init_options = config.init_options,
        settings = config.settings,
        flags = config.flags,
        on_exit = function() servers[root] = nil end,
      })
    end
    if servers[root] then vim.lsp.buf_attach_client(buffer, servers[root]) end
  end,
})
