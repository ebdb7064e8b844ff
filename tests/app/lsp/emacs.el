;; A session with `weft lsp` in Emacs, through what eglot gives its user: typing, the list of diagnostics, completion, hover, definitions, a
;; rename. Run by emacs.py in a copy of workspace/, behind docs/editors/emacs.el. Prints a line for each thing that is wrong, then how many
;; were checked. Does what the command loop would, which a batch has not.
(defvar checks 0)
(defvar failed 0)
(defun check (good what)
  (setq checks (1+ checks))
  (unless good
    (setq failed (1+ failed))
    (princ (format "FAILED: %s\n" what))))
(defun wait-for (what condition)
  (let ((end (+ (float-time) 100)))
    (while (and (not (funcall condition)) (< (float-time) end)) (accept-process-output nil 0.05))
    (check (funcall condition) what)))
(defun tell () (run-hooks 'post-command-hook) (eglot--signal-textDocument/didChange))
(defun diagnostics ()
  (flymake-start)
  (mapconcat (lambda (each) (format "%d: %s" (line-number-at-pos (flymake-diagnostic-beg each)) (flymake-diagnostic-text each)))
             (flymake-diagnostics) "; "))
(defun go-to (text)
  (goto-char (point-min))
  (search-forward text))
(defun replace-here (from to)
  (go-to from)
  (replace-match to t t)
  (tell))

(setq eglot-sync-connect 100 eglot-confirm-server-initiated-edits nil make-backup-files nil)
(find-file "main.json")
(tell)
(check (eglot-current-server) "a server for main.json")

;; Diagnostics as one types, and gone again.
(replace-here "\"source\": \"part.soft\"" "\"source\": \"part.sofd\"")
(wait-for "a mistyped resource is said at its place"
          (lambda () (string-match-p (format "\\`%d: .*W040" (line-number-at-pos)) (diagnostics))))
(replace-here "part.sofd" "part.so")
(wait-for "a shorter one, too" (lambda () (string-match-p "'part\\.so'" (diagnostics))))

;; Completion of what was begun.
(go-to "\"part.so")
(let* ((found (eglot-completion-at-point))
       (words (all-completions "" (nth 2 found))))
  (check (seq-some (lambda (word) (string-match-p "part\\.soft" word)) words) (format "completion offers the resources: %S" words)))
(replace-here "\"part.so\"" "\"part.soft\"")
(wait-for "nothing is wrong when it is mended" (lambda () (string-empty-p (diagnostics))))

;; Hover says what the plan does.
(go-to "\"sk")
(let ((hover (jsonrpc-request (eglot-current-server) :textDocument/hover (eglot--TextDocumentPositionParams))))
  (check (string-match-p "pass sky: fullscreen" (format "%S" hover)) (format "hover: %S" hover)))

;; From a resource to its declaration in the included file, from a slot into the shader.
(go-to "\"part.so")
(xref-find-definitions "part.soft")
(check (string-suffix-p "part.json" buffer-file-name) (format "part.soft is declared in part.json: %s" buffer-file-name))
(find-file "main.json")
(go-to "\"radi")
(xref-find-definitions "radiance")
(check (string-suffix-p "sky.frag.glsl" buffer-file-name) (format "radiance is declared in sky.frag.glsl: %s" buffer-file-name))
(check (eglot-managed-p) "the shader has the server, too")

;; Another name for the slot, from the shader: in both files.
(tell)
(eglot-rename "light")
(wait-for "the shader has the new name" (lambda () (save-excursion (goto-char (point-min)) (search-forward "out vec4 light;" nil t))))
(save-some-buffers t)

(princ (format "%d checks, %d failed\n" checks failed))
(kill-emacs (if (= failed 0) 0 1))
