// Nothing: the target of the precompiled header of what runs seldom needs a source.
