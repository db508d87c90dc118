-- How Neovim starts `ncvet lsp`. The variable g:ncvet may say more:
--   vim.g.ncvet = { path = '/opt/ncvet/bin/ncvet', settings = { dialect = 'haas-lathe' } }
local own = vim.g.ncvet or {}
local settings = own.settings or vim.empty_dict()

return {
  cmd = { own.path or 'ncvet', 'lsp' },
  filetypes = {
    'gcode', 'ncvet-din66025', 'ncvet-ecs', 'ncvet-fanuc-0m', 'ncvet-fanuc-0t',
    'ncvet-fanuc-lathe', 'ncvet-fanuc-mill', 'ncvet-haas-lathe', 'ncvet-haas-mill',
    'ncvet-haas-ngc-lathe',
    'ncvet-linuxcnc', 'ncvet-mefi', 'ncvet-nct-104m', 'ncvet-nct-104t', 'ncvet-sinumerik',
  },
  root_markers = { '.ncvet.json', '.git' },
  init_options = settings,
  settings = { ncvet = settings },
  -- The server checks an edit faster than one types: nothing is gained by waiting for the next one.
  flags = { debounce_text_changes = 0 },
}
