//! The page that says how devices are set up.

fn main() {
    buslens_page::app::devices();
}
