;;; ncvet.el --- Part programs checked by `ncvet lsp'  -*- lexical-binding: t; -*-

;; Package-Requires: ((emacs "26.3") (eglot "1.9"))

;;; Commentary:

;; A mode for CNC part programs, one for each control of which programs have an ending of their own,
;; and how Eglot starts the server for them.  `M-x eglot', or at every program:
;;   (add-hook 'ncvet-mode-hook #'eglot-ensure)

;;; Code:

(require 'eglot)

(defgroup ncvet nil "CNC part programs." :group 'languages)

(defcustom ncvet-path "ncvet" "The program `ncvet'." :type 'string)

(defcustom ncvet-settings nil
  "Settings of the server, a property list: (:dialect \"haas-lathe\" :ignore [\"style\"])."
  :type 'plist)

;;;###autoload
(define-derived-mode ncvet-mode prog-mode "NC"
  "CNC part programs; the control is found out from the text."
  (setq-local comment-start "(")
  (setq-local comment-end ")"))

;;;###autoload
(define-derived-mode ncvet-sinumerik-mode ncvet-mode "NC/Sinumerik"
  "CNC part programs for SINUMERIK."
  (setq-local comment-start ";")
  (setq-local comment-end ""))

;;;###autoload
(define-derived-mode ncvet-mefi-mode ncvet-mode "NC/MEFI"
  "CNC part programs for MEFI."
  (setq-local comment-start "\"")
  (setq-local comment-end ""))

;;;###autoload
(define-derived-mode ncvet-ecs-mode ncvet-mode "NC/ECS"
  "CNC part programs for ECS."
  (setq-local comment-start "'")
  (setq-local comment-end ""))

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
