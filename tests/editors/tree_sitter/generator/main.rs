// What `tree-sitter generate` does: makes src/parser.c of the grammar.js in a folder.
#![allow(warnings)]
mod generate;

fn main() {
    let folder = std::path::PathBuf::from(std::env::args().nth(1).expect("generate FOLDER"));
    let version = tree_sitter::LANGUAGE_VERSION;
    if let Err(error) = generate::generate_parser_in_directory(&folder, None, version, false, None) {
        eprintln!("{:?}", error);
        std::process::exit(1);
    }
}
