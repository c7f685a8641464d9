"""The named cases; ``contactstudy.verification.registry`` lists them all."""
