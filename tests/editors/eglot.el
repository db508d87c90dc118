;;; eglot.el --- Drives Emacs with Eglot as a user would  -*- lexical-binding: t; -*-

;;; Commentary:

;; `emacs --batch -q -l eglot.el'.  The plan, a JSON file that the variable NCVET_PLAN names, says which steps are to
;; be done one after the other, and with which programs; what went wrong is written into its `result', a line each,
;; and the last line is `done'.

;;; Code:

(setq gc-cons-threshold most-positive-fixnum)
(require 'package)
(package-initialize)
(require 'eglot)
(require 'json)
(require 'subr-x)
(require 'xref)

(defvar plan (let ((json-object-type 'plist)) (json-read-file (getenv "NCVET_PLAN"))))
(defvar step nil "What is being done: a part of the plan.")
(defvar said nil)
(defun say-wrong (format &rest words)
  (push (concat (plist-get step :step) ": " (apply #'format format words)) said))

(load (plist-get plan :plugin))
(setq ncvet-path (plist-get plan :ncvet)
      ncvet-settings (plist-get plan :settings)
      eglot-sync-connect 60
      eglot-autoshutdown nil
      eglot-confirm-server-initiated-edits nil
      make-backup-files nil
      create-lockfiles nil
      require-final-newline nil
      mode-require-final-newline nil
      enable-local-variables nil)

(defvar published (make-hash-table :test #'equal) "The version of each file's newest diagnostics.")
(cl-defmethod eglot-handle-notification :after
  ((_server eglot-lsp-server) (_method (eql textDocument/publishDiagnostics)) &key uri version &allow-other-keys)
  (puthash (file-truename (eglot--uri-to-path uri)) (or version 0) published))

(defun await (what condition)
  "Wait for CONDITION, a function, for at most half a minute; nil when it does not come."
  (let ((end (+ (float-time) 30)))
    (while (and (not (funcall condition)) (< (float-time) end))
      (accept-process-output nil 0.002))
    (or (funcall condition) (progn (say-wrong "waited in vain for %s" what) nil))))

(defun settle ()
  "Wait for the diagnostics of what the buffer holds."
  (eglot--signal-textDocument/didChange)
  (await (format "diagnostics of %s" buffer-file-name)
         (lambda () (>= (gethash (file-truename buffer-file-name) published -1) eglot--versioned-identifier))))

(defun open-program (program)
  (find-file (plist-get program :path))
  (unless (derived-mode-p 'ncvet-mode) (ncvet-mode))
  (unless (eglot-managed-p) (apply #'eglot (eglot--guess-contact)))
  (flymake-start)
  (settle))

(defun shown ()
  "The findings as `line:column severity rule'; columns count characters, from 1."
  (sort (mapcar (lambda (one)
                  (save-excursion
                    (goto-char (flymake-diagnostic-beg one))
                    (format "%d:%d %s %s" (line-number-at-pos) (1+ (- (point) (line-beginning-position)))
                            (pcase (flymake-diagnostic-type one)
                              ('eglot-error "error") ('eglot-warning "warning") (_ "style"))
                            (rule-of one))))
                (flymake-diagnostics))
        #'string<))

(defun rule-of (diagnostic)
  (let ((text (flymake-diagnostic-text diagnostic)))
    (and (string-match "\\[\\([^]]*\\)\\]" text) (match-string 1 text))))

(defun checked (program)
  "What the command line says of the buffer's text, which is written for it."
  (let ((file buffer-file-name) (list nil))
    (write-region nil nil file nil 'quiet)
    (set-visited-file-modtime)
    (with-temp-buffer
      (call-process (plist-get plan :ncvet) nil (list t nil) nil "check" "--format" "json" "--dialect"
                    (plist-get program :dialect) file)
      (goto-char (point-min))
      (seq-do (lambda (one)
                (when (equal (file-truename (plist-get one :path)) (file-truename file))
                  (push (format "%d:%d %s %s" (plist-get one :line) (plist-get one :column)
                                (plist-get one :severity) (plist-get one :rule))
                        list)))
              (plist-get (json-parse-buffer :object-type 'plist) :findings)))
    (sort list #'string<)))

(defun compare (program when)
  (let ((is (shown)) (due (checked program)))
    (unless (equal is due)
      (say-wrong "%s %s: Emacs shows\n  %s\n where the command line says\n  %s" buffer-file-name when
                 (string-join is "\n  ") (string-join due "\n  ")))))

(defmacro with-program (program &rest body)
  (declare (indent 1))
  `(when (open-program ,program)
     (unwind-protect (progn ,@body)
       (set-buffer-modified-p nil)
       (kill-buffer))))

(defun step-open ()
  "What is shown of programs that are opened is what the command line says of them."
  (seq-do (lambda (program) (with-program program (compare program "as it is opened"))) (plist-get step :programs)))

(defun step-edit ()
  "It stays so while lines are deleted, doubled and typed."
  (seq-do
   (lambda (program)
     (with-program program
       (let ((lines (line-number-at-pos (point-max))))
         (dolist (edit (list (lambda () (goto-char (point-min)) (forward-line (/ lines 3)) (kill-whole-line))
                             (lambda () (goto-char (point-min)) (forward-line (/ lines 2)) (yank))
                             (lambda () (goto-char (point-max)) (insert "G987 X1.\n"))
                             (lambda () (goto-char (point-min)) (insert "(äöü 𝄞) G987\n"))
                             (lambda () (goto-char (point-min)) (delete-char 9))
                             (lambda () (delete-region (point-min) (line-beginning-position 3)))))
           (funcall edit)
           (when (settle) (compare program "after an edit"))))))
   (plist-get step :programs)))

(defun mends-p (action rule)
  "Whether ACTION is the fix of a finding of RULE."
  (and (plist-member action :isPreferred)
       (equal rule (plist-get (elt (plist-get action :diagnostics) 0) :code))))

(defun line-text () (buffer-substring-no-properties (line-beginning-position) (line-end-position)))

(defun alike (rule line)
  "How many findings of RULE are in lines of this text: an edit above them does not change it."
  (save-excursion
    (seq-count (lambda (one)
                 (goto-char (flymake-diagnostic-beg one))
                 (and (equal (rule-of one) rule) (equal (line-text) line)))
               (flymake-diagnostics))))

(defun step-fix ()
  "Some findings are mended by their own fix."
  (let ((mended 0))
    (seq-do
     (lambda (program)
       (when (< mended 4)
         (with-program program
           (catch 'done
             (dolist (one (flymake-diagnostics))
               (goto-char (flymake-diagnostic-beg one))
               (let* ((before (buffer-string)) (rule (rule-of one))
                      (line (line-text)) (count (alike rule line))
                      (action (seq-find (lambda (each) (mends-p each rule))
                                        (eglot-code-actions (point) (flymake-diagnostic-end one)))))
                 (when action
                   (eglot--apply-workspace-edit (plist-get action :edit))
                   (when (equal before (buffer-string)) (say-wrong "%s changes nothing" (plist-get action :title)))
                   (when (settle)
                     (unless (< (alike rule line) count)
                       (say-wrong "%s: %s is there as before: %s" buffer-file-name rule (plist-get action :title)))
                     (compare program (plist-get action :title)))
                   (setq mended (1+ mended))
                   (throw 'done nil))))))))
     (plist-get step :programs))
    (when (= mended 0) (say-wrong "no program has a finding with a fix"))))

(defun hover ()
  "The text that the server gives at point, or nil."
  (let ((answer (jsonrpc-request (eglot--current-server-or-lose) :textDocument/hover
                                 (eglot--TextDocumentPositionParams))))
    (and answer (eglot--hover-info (plist-get answer :contents) (plist-get answer :range)))))

(defun go-to-place ()
  "To the step's line and column, which counts bytes."
  (goto-char (point-min))
  (forward-line (1- (plist-get step :line)))
  (goto-char (byte-to-position (+ (position-bytes (point)) (plist-get step :column)))))

(defun step-hoverAt ()
  "The hover of the step's place holds the words of `expect'."
  (with-program (elt (plist-get step :programs) 0)
    (go-to-place)
    (let ((text (or (hover) "")))
      (seq-do (lambda (word)
                (unless (string-match-p (regexp-quote word) text) (say-wrong "the hover lacks %s in %s" word text)))
              (plist-get step :expect)))))

(defun step-columns ()
  "The step's finding is under the text that it is about."
  (with-program (elt (plist-get step :programs) 0)
    (let ((one (seq-find (lambda (each) (equal (rule-of each) (plist-get step :rule))) (flymake-diagnostics))))
      (if (not one)
          (say-wrong "there is no finding of %s" (plist-get step :rule))
        (let ((text (buffer-substring-no-properties (flymake-diagnostic-beg one) (flymake-diagnostic-end one))))
          (unless (equal text (plist-get step :text)) (say-wrong "it is under %s" text)))))))

(defun step-definition ()
  "From the step's place to its target."
  (with-program (elt (plist-get step :programs) 0)
    (go-to-place)
    (let* ((found (xref-backend-definitions 'eglot (xref-backend-identifier-at-point 'eglot)))
           (place (and found (xref-item-location (car found))))
           (target (plist-get step :target)))
      (unless (and place
                   (file-equal-p (xref-location-group place) (plist-get target :path))
                   (equal (xref-location-line place) (plist-get target :line)))
        (say-wrong "the definition is at %s" place)))))

(defun step-rename ()
  "The step's place is renamed to `name'; `after' is the text then."
  (with-program (elt (plist-get step :programs) 0)
    (go-to-place)
    (eglot-rename (plist-get step :name))
    (unless (equal (buffer-string) (plist-get step :after)) (say-wrong "the text is\n%s" (buffer-string)))))

(seq-do
 (lambda (one)
   (setq step one)
   (condition-case problem
       (funcall (intern (concat "step-" (plist-get step :step))))
     (error (say-wrong "%s" (error-message-string problem))))
   (dolist (buffer (buffer-list)) (with-current-buffer buffer (set-buffer-modified-p nil)))
   (ignore-errors (eglot-shutdown-all)))
 (plist-get plan :steps))
(push "done" said)
(let ((coding-system-for-write 'utf-8))
  (write-region (concat (string-join (nreverse said) "\n") "\n") nil (plist-get plan :result) nil 'quiet))
(kill-emacs 0)

;;; eglot.el ends here
