"""A head against a reference: what its tables give to the record of a stand."""
