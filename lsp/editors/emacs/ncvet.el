;;; ncvet.el --- Part programs checked by `ncvet lsp'  -*- lexical-binding: t; -*-

;; Package-Requires: ((emacs "26.3") (eglot "1.9"))

;;; Commentary:

;; A mode for CNC part programs, one for each control of which programs have an ending of their own,
;; with their colours, and how Eglot starts the server for them.  `M-x eglot', or at every program:
;;   (add-hook 'ncvet-mode-hook #'eglot-ensure)

;;; Code:

(require 'eglot)
;; Beside this file, whether or not the folder is in `load-path'.
(require 'ncvet-colours
         (expand-file-name "ncvet-colours" (file-name-directory (or load-file-name buffer-file-name))))

(defgroup ncvet nil "CNC part programs." :group 'languages)

(defcustom ncvet-path "ncvet" "The program `ncvet'." :type 'string)

(defcustom ncvet-settings nil
  "Settings of the server, a property list: (:dialect \"haas-lathe\" :ignore [\"style\"])."
  :type 'plist)

(defun ncvet--finder (expression before after wanted)
  "A function that finds EXPRESSION for font-lock, up to a limit.
BEFORE and AFTER are classes of characters that are not beside it, WANTED one of which comes after it."
  (lambda (limit)
    (let ((case-fold-search t) found)
      (while (and (not found) (re-search-forward expression limit t))
        (let ((begin (match-beginning 0)) (end (match-end 0)))
          (setq found (and (< begin end)
                           (not (and before (> begin (point-min))
                                     (string-match-p before (string (char-before begin)))))
                           (not (and after (< end (point-max))
                                     (string-match-p after (string (char-after end)))))
                           (or (not wanted)
                               (and (< end (point-max)) (string-match-p wanted (string (char-after end)))))))
          ;; What is no match may begin one at its next character.
          (unless found (goto-char (1+ begin)))))
      found)))

(defun ncvet--keywords (language)
  "The font-lock keywords of LANGUAGE, a name of the server's."
  (mapcar (lambda (rule)
            (pcase-let ((`(,face ,expression ,before ,after ,wanted ,over) rule))
              (list (ncvet--finder expression before after wanted) 0 (list 'quote face) over)))
          (cdr (assq language ncvet-colours))))

(defun ncvet--set-up (language begin end)
  "Colours of LANGUAGE and its comments, which BEGIN and END mark."
  (setq-local font-lock-defaults (list (ncvet--keywords language) t t))
  (setq-local comment-start begin)
  (setq-local comment-end end))

;;;###autoload
(define-derived-mode ncvet-mode prog-mode "NC"
  "CNC part programs; the control is found out from the text."
  (ncvet--set-up 'gcode "(" ")"))

;;;###autoload
(define-derived-mode ncvet-sinumerik-mode ncvet-mode "NC/Sinumerik"
  "CNC part programs for SINUMERIK."
  (ncvet--set-up 'ncvet-sinumerik ";" ""))

;;;###autoload
(define-derived-mode ncvet-mefi-mode ncvet-mode "NC/MEFI"
  "CNC part programs for MEFI."
  (ncvet--set-up 'ncvet-mefi "\"" ""))

;;;###autoload
(define-derived-mode ncvet-ecs-mode ncvet-mode "NC/ECS"
  "CNC part programs for ECS."
  (ncvet--set-up 'ncvet-ecs "'" ""))

;; What the server calls the languages.
(put 'ncvet-mode 'eglot-language-id "gcode")
(put 'ncvet-sinumerik-mode 'eglot-language-id "ncvet-sinumerik")
(put 'ncvet-mefi-mode 'eglot-language-id "ncvet-mefi")
(put 'ncvet-ecs-mode 'eglot-language-id "ncvet-ecs")

;;;###autoload
(dolist (entry '(("\\.\\(nc\\|cnc\\|tap\\|eia\\|min\\|nct\\|ngc\\|din\\|iso\\|gcode\\)\\'" . ncvet-mode)
                 ("\\.\\(mpf\\|spf\\|arc\\)\\'" . ncvet-sinumerik-mode)
                 ("\\.ncp\\'" . ncvet-mefi-mode)
                 ("\\.ecs\\'" . ncvet-ecs-mode)))
  (add-to-list 'auto-mode-alist entry))

(defun ncvet-contact (&rest _)
  "How the server is started, and with which settings."
  (list ncvet-path "lsp" :initializationOptions (or ncvet-settings eglot--{})))

;; A server of its own for each mode: Eglot tells a server one language only.  What comes last is
;; looked at first, and every mode is an `ncvet-mode'.
(dolist (mode '(ncvet-mode ncvet-sinumerik-mode ncvet-mefi-mode ncvet-ecs-mode))
  (add-to-list 'eglot-server-programs (cons mode #'ncvet-contact)))

(provide 'ncvet)
;;; ncvet.el ends here
