-- Starts `weft lsp` for graphs and shaders, once for each folder that has a folder `shaders`. Neovim 0.7 or later.
local started = {}
vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile" }, {
  pattern = { "*.json", "*.glsl" },
  callback = function(args)
    local folder = vim.fn.fnamemodify(args.file, ":p:h")
    local shaders = vim.fn.finddir("shaders", vim.fn.escape(folder, " ") .. ";")
    if shaders == "" then return end
    local root = vim.fn.fnamemodify(shaders, ":p:h:h")
    local config = { name = "weft", cmd = { "weft", "lsp" }, root_dir = root }
    started[root] = started[root] or vim.lsp.start_client(config)
    vim.lsp.buf_attach_client(args.buf, started[root])
  end,
})
