//! The worker that reads logs.

fn main() {
    buslens::app::log_worker();
}
