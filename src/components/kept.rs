//! Lists that are edited, whose items keep their signals.

use leptos::prelude::*;

/// An item: what it is told apart by, and what it holds at the time.
pub struct Kept<K, T> {
    pub key: K,
    pub item: ArcRwSignal<T>,
}

impl<K: Clone, T> Clone for Kept<K, T> {
    fn clone(&self) -> Self {
        Self { key: self.key.clone(), item: self.item.clone() }
    }
}

/// The items, each with a signal of its own that tells only what changes in it. With a memo for each, everybody who
/// listens would be woken at each keystroke to ask whether it changed: a thousand of them in a long telegram.
pub fn kept<K, T>(items: impl Fn() -> Vec<T>, key: impl Fn(&T) -> K) -> impl Fn() -> Vec<Kept<K, T>>
where
    K: Clone + PartialEq + Send + Sync + 'static,
    T: PartialEq + Send + Sync + 'static,
{
    let before = StoredValue::new(Vec::<Kept<K, T>>::new());
    move || {
        let old = before.get_value();
        // Most stand behind the one before, as they did.
        let mut next = 0;
        let mut now = Vec::new();
        for item in items() {
            let key = key(&item);
            let at = old[next..].iter().position(|kept| kept.key == key).map(|at| next + at);
            let at = at.or_else(|| old[..next].iter().position(|kept| kept.key == key));
            let Some(at) = at else {
                now.push(Kept { key, item: ArcRwSignal::new(item) });
                continue;
            };
            next = at + 1;
            if old[at].item.with_untracked(|before| *before != item) {
                old[at].item.set(item);
            }
            now.push(old[at].clone());
        }
        before.set_value(now.clone());
        now
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stays_keeps_its_signal() {
        let owner = Owner::new();
        owner.set();
        let all = StoredValue::new(vec![("a", 1), ("b", 2), ("c", 3)]);
        let items = kept(move || all.get_value(), |item| item.0);
        let first = items();
        // Another stands before them, one is gone, one holds something else.
        all.set_value(vec![("n", 0), ("c", 3), ("b", 7)]);
        let then = items();
        let held: Vec<_> = then.iter().map(|kept| kept.item.get_untracked()).collect();
        assert_eq!(held, [("n", 0), ("c", 3), ("b", 7)]);
        assert_eq!(first[1].item.get_untracked(), ("b", 7), "who listens to b is told");
        assert_eq!(first[0].item.get_untracked(), ("a", 1), "what is gone stays as it was");
    }
}
