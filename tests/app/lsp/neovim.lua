-- A session with `weft lsp` in Neovim, through what its user calls: typing, the list of diagnostics, vim.lsp.buf.*, omnifunc. Run by neovim.py
-- in a copy of workspace/, with docs/editors/neovim.lua as configuration. Prints a line for each thing that is wrong, then how many were checked.
local checks, failed = 0, 0
local function check(good, what)
  checks = checks + 1
  if not good then
    failed = failed + 1
    io.stdout:write("FAILED: " .. what .. "\n")
  end
end
local function waitFor(what, condition)
  check(vim.wait(100000, condition, 20), what)
end
local function codes(buffer)
  local list = {}
  for _, each in ipairs(vim.diagnostic.get(buffer)) do
    table.insert(list, string.format("%d:%d %s", each.lnum + 1, each.col + 1, each.code or ""))
  end
  table.sort(list)
  return table.concat(list, ", ")
end
local function lineWith(buffer, text)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, -1, false)) do
    local column = line:find(text, 1, true)
    if column then return number, column - 1, line end
  end
  error("no line has " .. text)
end
local function goTo(text, into)
  local number, column = lineWith(0, text)
  vim.api.nvim_win_set_cursor(0, { number, column + (into or 0) })
end
local function replace(from, to)
  local number, _, line = lineWith(0, from)
  local start, stop = line:find(from, 1, true)
  vim.api.nvim_buf_set_lines(0, number - 1, number, false, { line:sub(1, start - 1) .. to .. line:sub(stop + 1) })
end
local function file()
  return vim.fn.fnamemodify(vim.api.nvim_buf_get_name(0), ":t")
end

local function session()
  vim.cmd("edit main.json")
  local main = vim.api.nvim_get_current_buf()
  waitFor("a server for main.json", function() return #vim.lsp.buf_get_clients(main) == 1 end)
  waitFor("the server's answer", function() local _, client = next(vim.lsp.buf_get_clients(main)); return client.server_capabilities ~= nil and client.initialized end)

  -- Diagnostics as one types, and gone again.
  replace('"source": "part.soft"', '"source": "part.sofd"')
  waitFor("a mistyped resource is said", function() return codes(main) ~= "" end)
  local number, column = lineWith(main, "part.sofd")
  check(codes(main):find(string.format("%d:%d W040", number, column + 1), 1, true), "at its place: " .. codes(main))
  replace('"source": "part.sofd"', '"source": "part.soft"')
  waitFor("and is gone when it is mended", function() return codes(main) == "" end)

  -- Completion of what was begun, by what <C-x><C-o> calls.
  replace('"source": "part.soft"', '"source": "part.so"')
  goTo('"part.so"', 8)
  local answers = vim.lsp.buf_request_sync(main, "textDocument/completion", vim.lsp.util.make_position_params(), 100000)
  local words = {}
  for _, answer in pairs(answers or {}) do
    for _, item in ipairs(vim.lsp.util.extract_completion_items(answer.result)) do words[item.label] = true end
  end
  check(words["part.soft"] and words["hdr"], "completion offers the resources: " .. vim.inspect(words))
  replace('"source": "part.so"', '"source": "part.soft"')

  -- Hover opens a window with the compiled plan.
  goTo('"sky"', 1)
  vim.lsp.buf.hover()
  local text = ""
  waitFor("hover opens a window", function()
    for _, window in ipairs(vim.api.nvim_list_wins()) do
      if vim.api.nvim_win_get_config(window).relative ~= "" then
        text = table.concat(vim.api.nvim_buf_get_lines(vim.api.nvim_win_get_buf(window), 0, -1, false), "\n")
        return true
      end
    end
  end)
  check(text:find("pass sky: fullscreen", 1, true) and text:find("step 0 of 3", 1, true), "hover says what the plan does: " .. text)

  -- Definitions: into the included file, and from a slot into the shader.
  goTo("part.soft", 6)
  vim.lsp.buf.definition()
  waitFor("a resource of an include leads to its file", function() return file() == "part.json" end)
  check(vim.api.nvim_get_current_line():find('"soft"', 1, true), "at its line: " .. vim.api.nvim_get_current_line())
  vim.cmd("buffer " .. main)
  goTo('"radiance"', 2)
  vim.lsp.buf.definition()
  waitFor("a slot leads to its shader", function() return file() == "sky.frag.glsl" end)
  check(vim.api.nvim_get_current_line():find("out vec4 radiance", 1, true), "at its declaration: " .. vim.api.nvim_get_current_line())

  -- Another name for the slot, in JSON and GLSL.
  local shader = vim.api.nvim_get_current_buf()
  vim.cmd("buffer " .. main)
  goTo('"radiance"', 2)
  vim.lsp.buf.rename("light")
  waitFor("the slot has its new name in the graph", function() return pcall(lineWith, main, '"light": "hdr"') end)
  waitFor("and in the shader", function() return pcall(lineWith, shader, "out vec4 light;") and pcall(lineWith, shader, "light = vec4(uv") end)
  waitFor("nothing is wrong after it", function() return codes(main) == "" end)
  vim.cmd("wall")
end

local good, message = pcall(session)
check(good, tostring(message))
io.stdout:write(string.format("%d checks, %d failed\n", checks, failed))
vim.cmd(failed == 0 and "qall!" or "cquit!")
