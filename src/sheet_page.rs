//! The page that prints telegrams and exports them.

fn main() {
    buslens_page::app::sheet();
}
