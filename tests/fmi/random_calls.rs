//! Random sequences of calls on the C interface against the reference model of the standard's state
//! machine.

use crate::calls;
use crate::host::{ANY_ORDER, messages_of};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// Calls that bring an instance into one of its states, since few sequences come there by chance.
const WAYS: [&[[u8; 8]]; 4] = [&[], &[[10; 8]], &[[10; 8], [11; 8]], &[[10; 8], [11; 8], [18; 8]]];

proptest! {
    #![proptest_config(Config { cases: 50_000, rng_seed: RngSeed::Fixed(2014), failure_persistence: None, ..Config::default() })]

    #[test]
    fn any_sequence_of_calls_is_answered_as_the_standard_says(
        first in any::<u8>(),
        way in 0..WAYS.len(),
        records in vec(any::<[u8; 8]>(), 0..calls::MOST_CALLS),
    ) {
        calls::run(&[&[first], WAYS[way].as_flattened(), records.as_flattened()].concat());
    }
}

/// What the fuzzer has found to reach code that nothing else did.
#[test]
fn the_corpus_of_the_fuzzer_is_answered_as_the_standard_says() {
    let mut count = 0;
    for file in std::fs::read_dir("fuzz/corpus/calls").expect("the corpus is part of the checkout") {
        calls::run(&std::fs::read(file.unwrap().path()).unwrap());
        count += 1;
    }
    assert!(count > 50, "{count} sequences");
    assert!(messages_of(ANY_ORDER).is_empty(), "the host keeps messages of random calls");
}
